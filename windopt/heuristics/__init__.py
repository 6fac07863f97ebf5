"""The paper's algorithms and their baseline, beside the exact methods they rival."""
