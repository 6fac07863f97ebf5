"""YAML is read without trust: whatever it holds, the reader answers or says what is wrong."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from windopt.errors import InvalidInput
from windopt.io.yaml_files import read_yaml


@pytest.fixture
def write(tmp_path):
    def write(text, name="farm.yaml"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def test_numbers_with_exponents_are_numbers(write):
    assert read_yaml(write("rated: 8e6\nother: [1.5E-3, -2e+1, .5e1]")) == {
        "rated": 8e6,
        "other": [1.5e-3, -20.0, 5.0],
    }


def test_a_file_below_the_folder_is_included(write):
    write("hub_height: 90", "turbines/small.yaml")
    assert read_yaml(write("turbines: !include turbines/small.yaml")) == {
        "turbines": {"hub_height": 90}
    }


def test_includes_are_relative_to_the_file_that_has_them(write):
    write("!include b.yaml", "turbines/a.yaml")
    write("7", "turbines/b.yaml")
    assert read_yaml(write("!include turbines/a.yaml")) == 7


@pytest.mark.parametrize("target", ["../secret.yaml", "/etc/passwd", "sub/../../secret.yaml"])
def test_nothing_outside_the_folder_is_included(write, target):
    write("secret", "secret.yaml")
    with pytest.raises(InvalidInput, match="below its own folder"):
        read_yaml(write(f"!include {target}", "plant/farm.yaml"))


def test_a_symbolic_link_does_not_lead_out_of_the_folder(write):
    secret = write("secret", "secret.yaml")
    path = write("!include link.yaml", "plant/farm.yaml")
    (path.parent / "link.yaml").symlink_to(secret)
    with pytest.raises(InvalidInput, match="below its own folder"):
        read_yaml(path)


def test_only_yaml_is_included(write):
    write("secret", "wind.nc")
    with pytest.raises(InvalidInput, match="YAML files only"):
        read_yaml(write("!include wind.nc"))


@pytest.mark.parametrize("bodies", [("!include a.yaml",), ("!include b.yaml", "!include a.yaml")])
def test_a_circle_of_includes_is_refused(write, bodies):
    for name, body in zip(("b.yaml", "a.yaml"), reversed(bodies), strict=False):
        write(body, name)
    with pytest.raises(InvalidInput, match="include"):
        read_yaml(write(bodies[0], "a.yaml"))


def test_a_tree_of_includes_cannot_explode(write):
    for level in range(12):
        write(f"[!include {level + 1}.yaml, !include {level + 1}.yaml]", f"{level}.yaml")
    write("0", "12.yaml")
    with pytest.raises(InvalidInput, match="at most 100 files"):
        read_yaml(write("!include 0.yaml"))


@pytest.mark.parametrize("tag", ["!!python/object:os.system", "!!python/name:os.system", "!new"])
def test_tags_are_refused_with_their_line(write, tag):
    with pytest.raises(InvalidInput, match="at line 2"):
        read_yaml(write(f"name: x\nlayouts: {tag} [ls]\n"))


def test_an_alias_bomb_is_refused(write):
    bomb = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    bomb += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 10)]
    with pytest.raises(InvalidInput, match="aliases"):
        read_yaml(write("\n".join(bomb)))


def test_a_bomb_of_merged_keys_is_refused(write):
    bomb = ["a0: &a0 {k: 1}"]
    bomb += [f"a{i}: &a{i} {{<<: [{', '.join([f'*a{i - 1}'] * 10)}]}}" for i in range(1, 10)]
    with pytest.raises(InvalidInput, match="aliases"):
        read_yaml(write("\n".join(bomb)))


def test_an_alias_within_its_own_anchor_is_refused(write):
    with pytest.raises(InvalidInput, match="aliases to themselves"):
        read_yaml(write("a: &a [1, *a]"))


def test_aliases_of_ordinary_size_are_read(write):
    assert read_yaml(write("a: &a [1, 2]\nb: *a")) == {"a": [1, 2], "b": [1, 2]}


@pytest.mark.parametrize("text", ["[" * 10_000, "a: " * 50 + "b", "- " * 3_000])
def test_deep_nesting_is_refused(write, text):
    with pytest.raises(InvalidInput):
        read_yaml(write(text))


def test_a_truncated_file_is_refused_with_its_name_and_line(write):
    with pytest.raises(InvalidInput, match=r"farm\.yaml .*line 3"):
        read_yaml(write("name: x\nlayouts:\n  - coordinates: {x: [1, 2,"))


@pytest.mark.parametrize(
    "text", ["2011-13-45", b"\xff\xfe\x00", b"a: \x00", "9" * 5000, "? [a]\n: b"]
)
def test_what_is_no_plain_yaml_is_refused(write, text):
    with pytest.raises(InvalidInput, match=r"farm\.yaml"):
        read_yaml(write(text))


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    for path in (tmp_path / "none.yaml", tmp_path):
        with pytest.raises(InvalidInput, match="readable file"):
            read_yaml(path)


PIECES = st.sampled_from(
    ["a: ", "- ", "[", "]", "{", "}", "&a ", "*a", "!include ", "!!str ", "1e5", "\n", "  ", "<<: "]
)


@given(text=st.lists(PIECES | st.text(max_size=3), max_size=30).map("".join))
def test_no_text_makes_the_reader_stumble(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("yaml") / "farm.yaml"
    path.write_text(text, encoding="utf-8", errors="surrogatepass")
    with suppress(InvalidInput):
        read_yaml(path)
