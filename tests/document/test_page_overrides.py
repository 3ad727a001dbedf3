"""Folders of own templates that would lead out of themselves or wear out the parser."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from reports.document.page.overrides import MAX_NESTED, find
from reports.shared.errors import InputError

NAME = "introduction.html.j2"


def folder_with(tmp_path: Path, text: str) -> Path:
    folder = tmp_path / "t"
    folder.mkdir()
    (folder / NAME).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.skipif(os.name == "nt", reason="links of Windows need leave")
@pytest.mark.parametrize("name", [NAME, "more.css", "part"])
def test_a_link_out_of_the_folder_is_refused(tmp_path: Path, name: str) -> None:
    folder = folder_with(tmp_path, "<p>своё</p>")
    assert find("t", tmp_path) == folder
    (secret := tmp_path / "secret").write_text("тайна", encoding="utf-8")
    (folder / name).unlink(missing_ok=True)
    (folder / name).symlink_to(tmp_path if name == "part" else secret)
    with pytest.raises(InputError, match="наружу"):
        find("t", tmp_path)


@pytest.mark.parametrize("block", ["<div>", "{% if 1 %}", "{%- for i in [1] %}"])
def test_blocks_nested_by_thousands_are_refused(tmp_path: Path, block: str) -> None:
    folder = folder_with(tmp_path, block * MAX_NESTED)
    assert find("t", tmp_path) == folder
    (folder / NAME).write_text(block * 3000, encoding="utf-8")
    with pytest.raises(InputError, match="вложены глубже"):
        find("t", tmp_path)


def test_many_blocks_beside_each_other_are_none_within_each_other(tmp_path: Path) -> None:
    folder = folder_with(tmp_path, "<div><p>раз<p>два</div>{% if 1 %}а{% endif %}" * 500)
    assert find("t", tmp_path) == folder
