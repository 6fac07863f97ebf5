"""Solvers behind one door: a program in, a :class:`windopt.result.Result` out."""
