"""Files are written whole or not at all."""

import os

import pytest

from windopt.errors import InvalidInput
from windopt.io.whole_files import write_whole


def test_missing_folders_are_made(tmp_path):
    assert write_whole(tmp_path / "a" / "b.txt", "ø").read_bytes() == "ø".encode()


def test_a_file_is_replaced_only_by_force(tmp_path):
    path = write_whole(tmp_path / "plan.json", "one")
    with pytest.raises(InvalidInput, match="--force"):
        write_whole(path, "two")
    assert path.read_text() == "one"
    assert write_whole(path, b"two", force=True).read_text() == "two"


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(InvalidInput, match="the folder"):
        write_whole(tmp_path, "text", force=True)


def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = write_whole(tmp_path / "plan.json", "old")

    def full(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_whole(path, "new", force=True)
    assert [p.name for p in tmp_path.iterdir()] == ["plan.json"]
    assert path.read_text() == "old"
