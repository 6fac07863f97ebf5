"""Every example in the pages is true, and every command in them ends as the page says."""

import doctest
import re
import shlex
import shutil
from pathlib import Path

import matplotlib
import pytest
from typer.testing import CliRunner

from windopt.cli.app import app

DOCS = Path(__file__).parents[1] / "docs"
PAGES = sorted(
    page
    for page in DOCS.rglob("*.rst")
    if not {"_build", "_templates", "tutorials", "generated"} & set(page.relative_to(DOCS).parts)
)
COMMAND = re.compile(r"^ +\$ (windopt (?:.*\\\n)*.*)", re.MULTILINE)


@pytest.fixture
def reader(tmp_path, monkeypatch):
    """Go to a folder with the files that the pages show."""
    shutil.copytree(DOCS / "how_to" / "files", tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    matplotlib.use("agg")


def titles(pages):
    return [str(page.relative_to(DOCS)) for page in pages]


@pytest.mark.usefixtures("reader")
@pytest.mark.parametrize("page", PAGES, ids=titles(PAGES))
def test_examples_print_what_the_page_shows(page):
    options = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    failed, _ = doctest.testfile(str(page), module_relative=False, optionflags=options)
    assert not failed


SCRIPTED = [page for page in PAGES if COMMAND.search(page.read_text(encoding="utf-8"))]


@pytest.mark.usefixtures("reader")
@pytest.mark.parametrize("page", SCRIPTED, ids=titles(SCRIPTED))
def test_commands_do_what_the_page_says(page):
    for command in COMMAND.findall(page.read_text(encoding="utf-8")):
        words = shlex.split(command.replace("\\\n", " "), comments=True)
        result = CliRunner().invoke(app, words[1:])
        assert result.exit_code == 0, f"{command}\n{result.output}"
