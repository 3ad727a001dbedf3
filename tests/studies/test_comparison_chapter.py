"""The comparison as a chapter of the report: what the file names, from where, what is refused."""

from __future__ import annotations

import pickle
import re

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.inputs.load import load_toml
from reports.shared.resources import samples_dir
from reports.studies.comparison import conclusions, read_engines, results
from reports.studies.comparison_page import comparison_chapters


def named(tmp_path, compare, *others):
    """The engine Д-240 whose report names other files, on a coarse grid."""
    for name in ("d-240", *others):
        text = (samples_dir() / f"{name}.toml").read_text(encoding="utf-8")
        text = re.sub(r"(?m)^step_deg = \d+", "step_deg = 30", text)
        if name == "d-240" and compare:
            text = text.replace("[report]", f'[report]\ncompare = "{compare}"')
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    return tmp_path / "d-240.toml"


def run(*args):
    done = CliRunner().invoke(main, [str(arg) for arg in args])
    return done.exit_code, done.output


def test_the_report_has_a_chapter_with_the_numbers_of_compare(tmp_path):
    path = named(tmp_path, "d-260.toml; yamz-236.toml", "d-260", "yamz-236")
    assert run("check", path)[0] == 1  # a coarse grid
    assert run("build", path, "--only", "html", "-o", tmp_path / "out")[0] < 2
    page = (tmp_path / "out" / "d-240.html").read_text(encoding="utf-8")
    assert "Сравнение с другими двигателями" in page
    plain = re.sub(r"\s+", " ", re.sub(r"<[^>]+>|\u00ad", "", page).replace("\u00a0", " "))
    assert re.search(r"результаты — таблицы \d+–\d+ и рисунки \d+–\d+\.", plain)
    assert 'шейки,<span> </span><span class="nb">мм</span>' in page  # no line divides a unit
    files = [path, tmp_path / "d-260.toml", tmp_path / "yamz-236.toml"]
    engines = read_engines(files, [load_toml(file).model for file in files])
    sentences = conclusions([engine.label for engine in engines], results(engines))
    assert len(sentences) > 5
    for sentence in sentences:
        assert sentence.replace("\u00a0", " ").replace("²", "2") in plain


def test_without_the_key_there_is_no_chapter_and_with_it_it_goes_to_other_machines(tmp_path):
    path = named(tmp_path, "", "d-260")
    assert comparison_chapters(path, load_toml(path)) == ()
    path = named(tmp_path, "d-260.toml")
    (chapter,) = comparison_chapters(path, load_toml(path))
    sent = pickle.loads(pickle.dumps(chapter))
    assert [label for label, *_ in sent.engines] == ["d-240", "d-260"]


@pytest.mark.parametrize(
    ("compare", "message"),
    [
        ("none.toml", "report.compare: нет файла {}/none.toml; укажите файлы от файла исходных "
         "данных, через точку с запятой"),
        ("d-240.toml", "{}/d-240.toml: файл назван дважды; уберите повтор или сделайте копию "
         "с правками"),
        ("d-260.toml; ./d-260.toml", "{}/d-260.toml: файл назван дважды; уберите повтор или "
         "сделайте копию с правками"),
        ("bad.toml", ""),
    ],
)  # fmt: skip
@pytest.mark.parametrize("command", [("check",), ("build", "--only", "xlsx", "-o", "OUT")])
def test_a_wrong_file_is_told_before_anything_is_built(tmp_path, compare, message, command):
    path = named(tmp_path, compare, "d-260")
    (tmp_path / "bad.toml").write_text("[geometry]\nbore_mm = 80\n", encoding="utf-8")
    out = tmp_path / "out"
    code, output = run(*(out if part == "OUT" else part for part in command), path)
    assert code == 2
    if compare == "bad.toml":
        assert output.startswith("bad.toml: engine: нет раздела")
    else:
        assert output.splitlines() == [message.format(tmp_path)]
    assert not out.exists()


def test_a_result_does_not_fall_on_a_file_that_is_compared(tmp_path):
    (tmp_path / "other").mkdir()
    path = named(tmp_path, "other/d-240.xlsx")
    sample = samples_dir() / "d-240.toml"
    assert run("build", sample, "--only", "xlsx", "-o", tmp_path / "other")[0] == 0
    book = tmp_path / "other" / "d-240.xlsx"
    before = book.read_bytes()
    code, output = run("build", path, "--only", "xlsx", "-o", tmp_path / "other")
    assert code == 2 and "результат лёг бы поверх ваших исходных данных" in output
    assert book.read_bytes() == before
