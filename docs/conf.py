"""How Sphinx builds these pages: ``sphinx-build -W -n -b html docs docs/_build/html``."""

import re
import sys
from collections.abc import Iterator
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import matplotlib
from docutils.nodes import Node
from numpy.typing import ArrayLike
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.typing import stringify_annotation
from typer.main import get_command
from typer.testing import CliRunner

import windopt
from windopt.cli.app import app as windopt_app

sys.path.insert(0, str(Path(__file__).parents[1]))  # the benchmarks are not installed
matplotlib.use("agg")

project = "windopt"
author = "The windopt developers"
copyright = f"2026, {author}"
release = version = windopt.__version__

extensions = [
    "matplotlib.sphinxext.plot_directive",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.doctest",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "examples", "how_to/files"]
templates_path = ["_templates"]

autodoc_preserve_defaults = True
autodoc_member_order = "bysource"
autosummary_ignore_module_all = False  # a package with __all__ shows just that
numpydoc_show_class_members = False  # autodoc lists them already

plot_html_show_formats = False
plot_html_show_source_link = False
plot_formats = [("png", 120)]

sphinx_gallery_conf = {
    "examples_dirs": "examples",
    "gallery_dirs": "tutorials",
    # One of them trains with torch, and is shown without having run where there is none.
    "filename_pattern": "/plot_" if find_spec("torch") else "/plot_(?!train)",
    "abort_on_example_error": True,
    "capture_repr": (),
    "download_all_examples": False,
    "write_computation_times": False,
    "show_signature": False,
}

html_theme = "pydata_sphinx_theme"
html_theme_options = {
    "navbar_end": ["theme-switcher"],
    "secondary_sidebar_items": ["page-toc"],
    "show_prev_next": False,
}
html_show_sourcelink = False

# Pages of other packages are not fetched, so that the build needs no network; a type variable has
# no page.
nitpick_ignore_regex = [
    (r"py:class", r"(collections|pathlib|threading)\..*"),  # standard library
    (r"py:class", r"(casadi|cvxpy|highspy|numpy|scipy|torch)\..*"),
    (r"py:class", r"Axes|DataFrame"),  # of matplotlib and pandas, imported for type checkers only
    (r"py:class", r"windopt\.result\.(Solution|Other)"),
    (r"py:class", r"windopt\.solving\.exact\.compiled\.Function"),
]

ARRAY = re.compile(r"~numpy\.ndarray\[tuple\[~typing\.Any, \.\.\.\], ~numpy\.dtype\[(~[\w.]+)\]\]")
ARRAY_LIKE = stringify_annotation(ArrayLike, "smart")


def shorten_arrays(*event: Any) -> tuple[str | None, ...]:
    """Write the types of arrays as the source does: ``NDArray[float64]``, ``ArrayLike``."""

    def short(signature: str) -> str:
        named = signature.replace(ARRAY_LIKE, "~numpy.typing.ArrayLike")
        return ARRAY.sub(r"~numpy.typing.NDArray[\1]", named)

    return tuple(part and short(part) for part in event[-2:])  # arguments, returned type


def commands_below(command: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield a command and all below it, each as the words that call it."""
    yield path
    for name, below in getattr(command, "commands", {}).items():
        yield from commands_below(below, (*path, name))


def write_command_line(app: Sphinx) -> None:
    """Write the page of commands from what each command's ``--help`` says."""
    environment = {"COLUMNS": "100", "NO_COLOR": "1", "TERM": "dumb"}
    call = partial(CliRunner().invoke, windopt_app, env=environment, prog_name="windopt")
    texts = [call([*words, "--help"]).output for words in commands_below(get_command(windopt_app))]
    page = Path(app.srcdir, "reference", "generated", "command_line.txt")
    page.parent.mkdir(exist_ok=True)
    page.write_text("\n".join(texts), encoding="utf-8")


def write_benchmarks(app: Sphinx) -> None:
    """Write the pages of what was measured from the lines that are kept."""
    from benchmarks.report.pages import write_pages

    lines = Path(app.srcdir).parent / "benchmarks" / "results"
    write_pages(lines, Path(app.srcdir, "benchmarks", "generated"))


def resolve_public_name(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, contnode: Node
) -> Any:
    """Link ``windopt.Farm`` to where Farm is described, ``windopt.domain.farm.Farm``."""
    package, _, path = node.get("reftarget", "").partition(".")
    name = path.partition(".")[0]
    if package != "windopt" or name not in windopt.__all__:
        return None
    target = f"{windopt._ROOMS[name]}.{path}"
    python = env.domains.python_domain
    return python.resolve_xref(env, node["refdoc"], app.builder, "obj", target, node, contnode)


def setup(app: Sphinx) -> None:
    """Connect the functions above."""
    app.connect("autodoc-process-signature", shorten_arrays)
    app.connect("builder-inited", write_command_line)
    app.connect("builder-inited", write_benchmarks)
    app.connect("missing-reference", resolve_public_name)
