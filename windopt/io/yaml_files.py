"""YAML read without trust: no tags but ``!include``, no bombs, nothing outside the folder."""

import re
from pathlib import Path
from typing import Any

import yaml

from windopt.errors import InvalidInput

MAX_BYTES = 5_000_000
MAX_DEPTH = 40
MAX_NODES = 1_000_000  # with every alias written out
MAX_INCLUDES = 100


class _Loader(yaml.SafeLoader):
    """PyYAML's safe loader, with ``!include``, bounded depth and bounded aliases."""

    file: Path
    folder: Path
    opened: list[Path]

    def __init__(self, stream: str) -> None:
        super().__init__(stream)
        self.depth = 0
        self.size: dict[int, int] = {}

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        alias = self.check_event(yaml.AliasEvent)
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.refuse(f"nested at most {MAX_DEPTH} deep", "deeper nesting")
        node = super().compose_node(parent, index)
        self.depth -= 1
        if not alias and node is not None:
            self.size[id(node)] = self._size_of(node)
        elif id(node) not in self.size:
            raise self.refuse("free of aliases to themselves", f"one at line {self.line + 1}")
        return node

    def _size_of(self, node: yaml.Node) -> int:
        """Count the nodes below ``node``, so that aliases of aliases cannot explode."""
        size = 1
        if isinstance(node, yaml.SequenceNode):
            size += sum(self.size[id(child)] for child in node.value)
        elif isinstance(node, yaml.MappingNode):
            size += sum(self.size[id(child)] for pair in node.value for child in pair)
        if size > MAX_NODES:
            raise self.refuse(f"of at most {MAX_NODES} nodes", "more, through its aliases")
        return size

    def include(self, node: yaml.Node) -> Any:
        if not isinstance(node, yaml.ScalarNode):
            raise self.refuse("to include files by name", f"line {node.start_mark.line + 1}")
        target = (self.file.parent / str(node.value)).resolve()
        if not target.is_relative_to(self.folder):
            raise self.refuse("to include only files below its own folder", node.value)
        if target.suffix.lower() not in (".yaml", ".yml"):
            raise self.refuse("to include YAML files only", node.value)
        if len(self.opened) > MAX_INCLUDES:
            raise self.refuse(f"to include at most {MAX_INCLUDES} files", node.value)
        return _load(target, self.folder, self.opened)

    def refuse(self, expected: str, got: object) -> InvalidInput:
        return InvalidInput(f"{self.file.name}", expected, got)


_Loader.add_constructor("!include", _Loader.include)
# YAML 1.1 reads 8e6 as a text and 1.2 as a number; windIO is written by the latter.
_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)[eE][-+]?[0-9]+$"),
    list("-+.0123456789"),
)


def read_yaml(path: str | Path) -> Any:
    """Read a YAML file and the files it includes.

    Raises
    ------
    InvalidInput
        Naming the file and, where the YAML is at fault, the line.
    """
    path = Path(path).resolve()
    try:
        return _load(path, path.parent, [])
    except RuntimeError:  # of Python's stack, or of a symbolic link to itself
        raise InvalidInput(path.name, "to include no file that includes it", "a circle") from None


def _load(path: Path, folder: Path, opened: list[Path]) -> Any:
    opened.append(path)
    try:
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise InvalidInput(path.name, f"of at most {MAX_BYTES // 10**6} MB", "a larger file")
        loader = _Loader(content.decode("utf-8-sig"))
        loader.file, loader.folder, loader.opened = path, folder, opened
        return loader.get_single_data()
    except OSError as error:
        raise InvalidInput(str(path), "to be a readable file", error.strerror) from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = f" at line {mark.line + 1}" if mark else ""
        raise InvalidInput(path.name, "to be complete YAML", f"{error.problem}{line}") from None
    except InvalidInput:
        raise
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        reason = str(error).splitlines()[0]
        raise InvalidInput(path.name, "to be readable YAML", reason) from None
