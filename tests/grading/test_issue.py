"""Issuing: rosters as people make them, variants that differ, nothing given away."""

from __future__ import annotations

import io
import json
import re
import tomllib
import zipfile

import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from reports.cli import main
from reports.exports.build import load_input
from reports.grading.issuing.assignment import assignment_of
from reports.grading.issuing.handout import _live_cells, fill_cells
from reports.grading.issuing.issue import draw_variants, issue, load_base
from reports.grading.issuing.names import latin
from reports.grading.issuing.register import load_register
from reports.grading.issuing.roster import read_roster
from reports.grading.issuing.rubric import Rubric, load_rubric, rubric_of
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from reports.workbook.layout import Cell, Layout
from tests.grading import classroom


@pytest.mark.parametrize(
    ("name", "spelt"),
    [
        ("Қасымов Нұрлан", "kasymov nurlan"), ("Ґалаґан Їжак", "galagan izhak"),
        ("Ўладзімір", "uladzimir"), ("Ёжиков Йорданов", "ezhikov yordanov"),
        ("И\u0306орданов", "yordanov"), ("Müller Şahin", "muller sahin"), ("李 Wei", "李 wei"),
    ],
)  # fmt: skip
def test_names_of_neighbours_are_spelt_in_latin(name, spelt):
    assert latin(name) == spelt


def base(tmp_path, ranges):
    path = tmp_path / "base.toml"
    text = classroom.base_text().split("[variants]")[0]
    path.write_text(text + ranges, encoding="utf-8")
    return path


def test_variants_are_repeatable_and_differ(tmp_path):
    path = base(tmp_path, '[variants]\n"geometry.bore_mm" = {min = 84, max = 92, step = 0.5}\n'
                          '"crankshaft.webs.1.mass_kg" = {values = [0.24, 0.245]}\n')  # fmt: skip
    loaded = load_base(path)
    people = [f"s{i}" for i in range(20)]
    first = draw_variants(loaded, people, 1)
    assert len({variant.key for variant in first}) == 20
    assert [v.drawn for v in first] == [v.drawn for v in draw_variants(loaded, people, 1)]
    assert [v.drawn for v in first] != [v.drawn for v in draw_variants(loaded, people, 2)]
    # A student more changes nobody else's variant.
    assert [v.drawn for v in draw_variants(loaded, [*people, "new"], 1)][:20] == [
        v.drawn for v in first
    ]
    assert (
        first[0].raw["crankshaft"]["webs"][0]["mass_kg"]
        == first[0].drawn["crankshaft.webs.1.mass_kg"]
    )
    assert all(not variant.loaded.warnings for variant in first)


@pytest.mark.parametrize(
    ("ranges", "words"),
    [
        ("", r"нет раздела \[variants\]"),
        ("[variants]\n", "пуст"),
        ('[variants]\n"geometry.bore" = {min = 1, max = 2, step = 1}\n', "нет такого параметра"),
        ('[variants]\n"geometry.bore_mm" = {min = 2, max = 1, step = 1}\n', "min ≤ max"),
        ('[variants]\n"geometry.bore_mm" = {min = 1, max = 2}\n', "неверные ключи"),
        ('[variants]\n"geometry.bore_mm" = 5\n', "это не диапазон"),
        ('[variants]\n"geometry.bore_mm" = {min = -1e308, max = 1e308, step = 1}\n', "мелкий шаг"),
        ('[variants]\n"geometry.bore_mm" = {min = 0, max = 1e300, step = 1e-300}\n', "мелкий шаг"),
        ('[variants]\n"geometry.bore_mm" = {values = [88, 88]}\n', "повторы"),
    ],
)
def test_bad_ranges_are_refused(tmp_path, ranges, words):
    with pytest.raises(InputError, match=words):
        load_base(base(tmp_path, ranges))


def test_too_few_variants_are_refused(tmp_path):
    path = base(tmp_path, '[variants]\n"geometry.bore_mm" = {values = [86, 88, 90]}\n')
    with pytest.raises(InputError, match="вариантов в диапазонах 3, а студентов 4"):
        draw_variants(load_base(path), list("abcd"), 1)
    # A rod shorter than the crank does not pass the check.
    path = base(tmp_path, '[variants]\n"geometry.rod_length_mm" = {values = [10, 20, 148]}\n')
    why = "хватило только на 1 из 2 студентов; один из отказов — .*geometry.rod_length_mm"
    with pytest.raises(InputError, match=why):
        draw_variants(load_base(path), list("ab"), 1)


def test_an_issue_can_be_repeated_and_every_variant_passes_the_check(tmp_path):
    first = classroom.issue_class(tmp_path, 3)
    mode = (tmp_path / "secret.key").stat().st_mode & 0o777
    assert first.new_secret is not None
    assert mode == 0o600
    before = {p.name: p.read_bytes() for p in (tmp_path / "issued").rglob("*") if p.is_file()}
    again = classroom.issue_class(tmp_path, 3)
    after = {p.name: p.read_bytes() for p in (tmp_path / "issued").rglob("*") if p.is_file()}
    assert again.new_secret is None
    assert before == after
    for book in first.register.books:
        toml = tmp_path / "issued" / book.folder / book.file.replace(".xlsx", ".toml")
        assert load_input(toml).warnings == ()
    assert load_register(tmp_path / "issued") == first.register
    assert len({book.ticket for book in first.register.books}) == 3


def test_books_written_by_two_processes_are_the_same(tmp_path):
    alone, both = (
        classroom.issue_class(tmp_path / str(jobs), 3, jobs=jobs).folder for jobs in (1, 2)
    )
    for path in sorted(alone.rglob("*.xlsx")):
        assert path.read_bytes()[:2] == b"PK"
        names = [zipfile.ZipFile(folder / path.relative_to(alone)) for folder in (alone, both)]
        first, second = ({n: book.read(n) for n in book.namelist()} for book in names)
        same = {n for n in first if first[n] == second[n]}
        assert first.keys() == second.keys()
        assert {"xl/styles.xml", "xl/worksheets/sheet3.xml"} <= same


@pytest.fixture
def books_are_empty(monkeypatch):
    """What is asked of the register alone needs no work-books, which take a second each."""
    monkeypatch.setattr(classroom.issuing.Handouts, "__call__", lambda *given: b"")


@pytest.mark.usefixtures("books_are_empty")
def test_a_latecomer_and_one_who_leaves_orphan_no_book(tmp_path):
    """Whatever the list becomes: a name in the middle, a mail more, another order, a return."""
    first = classroom.issue_class(tmp_path, 5).register
    handed = {book.student.full: book for book in first.books}
    lines = classroom.roster_text(5).splitlines()
    mails = [line.rpartition(";")[0] for line in lines]
    lists = [
        [*lines[:2], "Ильин;Илья;ДВС-1;i@example.org", *lines[2:]],
        [*lines[:2], "Ильин;Илья;ДВС-1;i@example.org", *lines[3:]],
        [mails[0], *reversed(mails[1:]), "Ильин;Илья;ДВС-1"],
        [*lines[:1], "Якин;Ян;ДВС-1;j@example.org", *lines[1:]],
        lines,
    ]
    for number, text in enumerate(lists):
        (tmp_path / "group.csv").write_text("\n".join(text), encoding="utf-8")
        done = issue(tmp_path / "base.toml", tmp_path / "group.csv", tmp_path / "issued", seed=7,
                     secret_file=tmp_path / "secret.key")  # fmt: skip
        register = load_register(tmp_path / "issued")
        assert register == done.register
        assert {book.student.full for book in register.books} == {
            " ".join(line.split(";")[:2]) for line in text[1:]
        }
        for book in (*register.books, *register.former):
            before = handed.setdefault(book.student.full, book)
            same = ("number", "file", "folder", "ticket", "drawn", "raw")
            assert [getattr(book, key) for key in same] == [getattr(before, key) for key in same]
        numbers = [book.number for book in (*register.books, *register.former)]
        assert len(set(numbers)) == len(numbers) == len(handed)
        assert register.trial_seed == first.trial_seed, number
        register.check(bytes.fromhex((tmp_path / "secret.key").read_text()), tmp_path)
    assert done.kept == 5 and len(register.former) == 2


@pytest.mark.usefixtures("books_are_empty")
@pytest.mark.parametrize(
    ("what", "words"),
    [("seed", "по другой базе, другим диапазонам или другому зерну"),
     ("base", "по другой базе, другим диапазонам или другому зерну"),
     ("secret", "секрет не читается"), ("another", "не соответствует секрету"),
     ("register", "это не реестр kshm или он повреждён")],
)  # fmt: skip
def test_a_second_issue_that_would_orphan_books_is_refused(tmp_path, what, words):
    classroom.issue_class(tmp_path, 2)
    if what == "base":
        text = classroom.base_text().replace("step = 50", "step = 100")
        (tmp_path / "base.toml").write_text(text, encoding="utf-8")
    elif what == "secret":
        (tmp_path / "secret.key").unlink()
    elif what == "another":
        (tmp_path / "secret.key").write_text("ab" * 32, encoding="ascii")
    elif what == "register":
        (tmp_path / "issued" / "register.json").write_text("{", encoding="utf-8")
    before = {p: p.read_bytes() for p in (tmp_path / "issued").rglob("*") if p.is_file()}
    with pytest.raises(InputError, match=words):
        issue(tmp_path / "base.toml", tmp_path / "group.csv", tmp_path / "issued",
              seed=8 if what == "seed" else 7, secret_file=tmp_path / "secret.key")  # fmt: skip
    assert {p: p.read_bytes() for p in (tmp_path / "issued").rglob("*") if p.is_file()} == before
    assert (tmp_path / "secret.key").exists() == (what != "secret")


@pytest.mark.usefixtures("books_are_empty")
def test_the_command_says_who_is_issued_of_how_many_lines(tmp_path):
    classroom.issue_class(tmp_path, 2)
    text = classroom.roster_text(3).splitlines()
    text.insert(1, "Points Possible;;;")
    del text[2]
    (tmp_path / "group.csv").write_text("\n".join(text), encoding="utf-8")
    places = {"--roster": "group.csv", "-o": "issued", "--secret": "secret.key"}
    words = ["issue", str(tmp_path / "base.toml"), "--seed=7"]
    words += [word for key, name in places.items() for word in (key, str(tmp_path / name))]
    said = CliRunner().invoke(main, words).output
    assert "выдано вариантов: 2, строк с именем в списке: 3" in said
    assert "Не выдано: group.csv, строка 2: «Points Possible» — служебная строка" in said
    assert "сохранены: 1; новые варианты: 3 (Сидорова Имя)" in said
    assert "Нет в списке, варианты оставлены за ними: 1 (Иванов Имя)" in said


@pytest.mark.usefixtures("books_are_empty")
def test_the_secret_may_not_go_out_with_the_books(tmp_path):
    classroom.issue_class(tmp_path, 1)
    with pytest.raises(InputError, match="не должен лежать в папке выдачи"):
        issue(tmp_path / "base.toml", tmp_path / "group.csv", tmp_path / "out", seed=1,
              secret_file=tmp_path / "out" / "secret.key")  # fmt: skip
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.doc").write_bytes(b"x")
    with pytest.raises(InputError, match="чужие файлы"):
        issue(tmp_path / "base.toml", tmp_path / "group.csv", tmp_path / "mine", seed=1,
              secret_file=tmp_path / "secret.key")  # fmt: skip
    assert (tmp_path / "mine" / "thesis.doc").exists()


@pytest.mark.usefixtures("books_are_empty")
def test_a_changed_register_is_refused(tmp_path):
    done = classroom.issue_class(tmp_path, 2)
    path = tmp_path / "issued" / "register.json"
    data = json.loads(path.read_text(encoding="utf-8"))
    data["books"][0]["raw"]["geometry"]["bore_mm"] = 99.0
    path.write_text(json.dumps(data), encoding="utf-8")
    secret = bytes.fromhex((tmp_path / "secret.key").read_text())
    done.register.check(secret, path)
    with pytest.raises(InputError, match="не соответствует секрету"):
        load_register(tmp_path / "issued").check(secret, path)


def test_a_handout_gives_nothing_away():
    book = load_workbook(io.BytesIO(classroom.handout()))
    assignment = classroom.assignment()
    values = evaluate_model(assignment.model)
    secret = {
        round(float(value), 6)
        for node in assignment.fill_nodes
        for value in (
            values.columns[node.split(".")[0]][node.split(".")[1]] if "." in node
            else [values.scalars[node]]
        )
        if not isinstance(value, str) and abs(value) > 1e-3 and round(float(value), 3) != value
    }  # fmt: skip
    given = {
        round(float(cell.value), 6)
        for sheet in book.worksheets
        for line in sheet.iter_rows()
        for cell in line
        if isinstance(cell.value, (int, float))
    }
    allowed = {
        round(float(v), 6)
        for node in assignment.given_nodes
        for v in (
            values.columns[node.split(".")[0]][node.split(".")[1]] if "." in node
            else [values.scalars[node]]
        )
        if not isinstance(v, str)
    }  # fmt: skip
    inputs = {
        round(float(f.value), 6)
        for f in assignment.model.inputs
        if isinstance(f.value, (int, float))
    }
    assert not (secret - allowed - inputs) & given
    layout = Layout.of(assignment.model)
    live = _live_cells(assignment, layout)
    assert live
    unlocked = set()
    for sheet in book.worksheets:
        assert sheet.protection.sheet, sheet.title
        for line in sheet.iter_rows():
            for cell in line:
                if isinstance(cell.value, str) and cell.value.startswith("="):
                    assert Cell(sheet.title, cell.row, cell.column) in live, cell
                if not cell.protection.locked:
                    assert cell.value is None, (sheet.title, cell.coordinate)
                    unlocked.add(Cell(sheet.title, cell.row, cell.column))
    assert unlocked == {  # and nothing that is asked stays closed
        position
        for block in assignment.fill
        for node, places in fill_cells(block, layout).items()
        if node in assignment.fill_nodes
        for position in places
    }
    with zipfile.ZipFile(io.BytesIO(classroom.handout())) as archive:
        for name in archive.namelist():
            if name.startswith("xl/charts/"):
                shown = re.findall(rb"<yVal>.*?</yVal>", archive.read(name), re.S)
                assert shown
                for curve in shown:  # only what is given may be drawn, and the pole at zero
                    pole = set(re.findall(rb"<v>([^<]*)</v>", curve)) == {b"0"}
                    assert b"<v>" not in curve or pole or "Газы".encode() in curve


def test_the_sample_of_a_class_can_be_issued(tmp_path):
    folder = samples_dir() / "class"
    loaded = load_base(folder / "base.toml")
    people = [student.id for student in read_roster(folder / "group.csv")]
    assert len(draw_variants(loaded, people, 1)) == 5
    rubric = load_rubric(folder / "rubric.toml")
    # The sample shows the defaults; only the examples of points, times and limits differ.
    plain = rubric.model_copy(
        update={"points": {}, "late": Rubric().late, "tolerance": Rubric().tolerance,
                "work": rubric.work.model_copy(update={"title": ""})}
    )  # fmt: skip
    assert plain == Rubric()
    assert rubric.tolerance.units == Rubric().tolerance.units


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[credit]\ncarried = 2\n", "credit.carried: недопустимое значение 2; нужно число от 0"),
        ("[credit]\ncaried = 1\n", "credit.caried: неизвестный ключ; возможно, .* carried"),
        ("[feedback]\nmode = 'all'\n", "hints"),
        ("x = [", "rubric.toml"),
        ("[late]\ndeadline = 'завтра'\n", "late.deadline"),
        ("[late]\ndeadline = 2026-12-20\n", "нужна дата и время: 2026-12-20T23:59"),  # begins then
        (
            "[late]\nper_day = 0.1\n",
            "late.per_day: без ключа deadline",
        ),
        ("[late]\ndeadline = 2026-12-20T23:59:00\nleast = 0.5\n", "late.least: без ключа per_day"),
        ("[[work]]\n", "work: недопустимое значение список; нужен раздел"),
    ],
)
def test_a_bad_rubric_is_refused(tmp_path, text, words):
    path = tmp_path / "rubric.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words):
        load_rubric(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[work]\nfill = ["P9_9"]\n', "нет таблицы P9_9; есть: "),
        ('[points]\n"P3_1.x" = 2\n', r"заполняемой таблицы или столбца P3_1\.x; возможно, P3_1"),
        ('[points]\n"geometry.omegas" = 2\n', "возможно, geometry.omega"),
        ('[work]\nwithout = ["P3_1.nope"]\n', r"нет столбца P3_1\.nope; есть: P3_1\.s1_mm"),
        ('[work]\ngiven = ["P3_2"]\n', "given: таблица P3_2 и дана, и заполняется"),
        ("[work]\nfill = []\n", r"ни один столбец не оценивается; .*\[work\]"),
    ],
)  # fmt: skip
def test_a_rubric_that_does_not_fit_the_engine_is_refused(text, words):
    with pytest.raises(InputError, match=words):
        assignment_of(classroom.assignment().model, rubric_of(tomllib.loads(text), "rubric.toml"))


@pytest.mark.parametrize(
    ("key", "values", "words"),
    [
        ("crankshaft.webs.0.mass_kg", "[0.2, 0.3]", "в файле нет такого параметра"),
        ("report.student", '["А", "Б"]', "расчёт от этого параметра не зависит"),
        ("engine.name", '["А", "Б"]', "расчёт от этого параметра не зависит"),
    ],
)
def test_what_makes_no_other_engine_is_no_variant(tmp_path, key, values, words):
    with pytest.raises(InputError, match=words):
        load_base(base(tmp_path, f'[variants]\n"{key}" = {{values = {values}}}\n'))
