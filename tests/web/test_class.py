"""A class of five in the browser: from its issue to Moodle's file, seen by both sides."""

from __future__ import annotations

import csv
import io
import zipfile
from pathlib import Path
from typing import Any

import pytest
from itsdangerous import URLSafeSerializer
from openpyxl import Workbook

from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import load_register
from reports.inputs.form_fields import groups
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.test_decisions import UNKNOWN
from tests.grading.test_moodle import ENGLISH, worksheet
from tests.web import axe
from tests.web.conftest import MARK, Served, opened, photo, until

WAIT = 90_000


@pytest.fixture(scope="module")
def teacher(browser: Any, served: Served) -> Any:
    """The instructor, come in by the printed address."""
    page = opened(browser, served.teacher)
    page.wait_for_selector("#inside:not([hidden])")
    yield page
    page.context.close()


def stored(served: Served) -> Path:
    """The class as it lies on the server's disk: its register is the test's key to the answers."""
    (item,) = (path for path in (served.data / "classes").iterdir() if path.is_dir())
    return item


def taken(page: Any, selector: str) -> bytes:
    with page.expect_download() as download:
        page.click(selector)
    return Path(download.value.path()).read_bytes()


def points(page: Any) -> dict[str, str]:
    """Surname → what the gradebook on the page shows."""
    rows = page.locator("#class [aria-label=Ведомость] tbody tr").all()
    cells = [[cell.inner_text() for cell in row.locator("td").all()] for row in rows]
    return {row[0].split()[1]: row[2] for row in cells}  # after the number


def roster_book(count: int) -> bytes:
    """The list of a class as a book of Excel."""
    built = Workbook()
    built.active.append(["Список группы"])
    for line in classroom.roster_text(count).splitlines():
        built.active.append(line.split(";"))
    stream = io.BytesIO()
    built.save(stream)
    return stream.getvalue()


def base_bytes() -> str:
    """The engine of the class as the page sends a file: one character a byte."""
    return classroom.base_text().encode().decode("latin-1")


def not_issued(page: Any, served: Served, roster: bytes, seed: str) -> str:
    """The name of a class that could not be issued."""
    door, ask = f"{served.page}api/teacher", page.context.request
    data = {"title": "?", "base.toml": base_bytes(), "seed": seed,
            "roster": roster.decode("latin-1")}  # fmt: skip
    name: str = ask.post(door, data=data, headers=MARK).json()["name"]
    for _ in range(WAIT // 100):
        if ask.get(f"{door}/{name}").json()["state"] == "failed":
            return name
        page.wait_for_timeout(100)
    raise AssertionError(ask.get(f"{door}/{name}").json())


def heights(page: Any) -> dict[str, int]:
    """What is pressed on the page, as high as it is on a phone."""
    page.set_viewport_size({"width": 390, "height": 900})
    collected: dict[str, int] = page.evaluate("""Object.fromEntries([...document.querySelectorAll(
        "main :is(button, select, summary, .button, .bar > label)")]
        .filter(e => e.offsetHeight).map(e => [e.innerText.slice(0, 30), e.offsetHeight]))""")
    page.set_viewport_size({"width": 1280, "height": 900})
    return collected


def decide(page: Any, who: str, what: str, worth: str, remark: str = "") -> None:
    """Decide as the instructor does, and wait until the gradebook says so."""
    form = page.locator(f"[aria-label=Ведомость] tr:has-text('{who}') form")
    if not form.is_visible():
        page.locator(f"[aria-label=Ведомость] tr:has-text('{who}') summary").click()
    form.locator("select").select_option(what)
    form.locator("input").nth(0).fill(worth)
    form.locator("input").nth(1).fill(remark)
    form.locator("button").click()
    until(page, "document.querySelector('#class [role=status]').textContent.includes('идёт')")
    until(page, "document.querySelector('#class [role=status]').textContent.includes('Проверено')")


def test_the_printed_address_is_a_door_for_the_instructor_alone(
    browser: Any, served: Served, teacher: Any
) -> None:
    assert "#" not in teacher.url
    stranger = opened(browser, served.page + "teacher")
    stranger.wait_for_selector("#login:not([hidden])")
    assert not stranger.is_visible("#inside")
    assert axe.faults(stranger) == []
    stranger.fill("#token", "not the key")
    stranger.keyboard.press("Enter")
    until(stranger, "document.getElementById('errors').textContent.includes('неверный ключ')")
    stranger.context.close()


@pytest.mark.parametrize("width", [390, 1366, 1920])
def test_no_label_of_the_instructors_form_lies_over_another(teacher: Any, width: int) -> None:
    teacher.set_viewport_size({"width": width, "height": 900})
    boxes = teacher.evaluate("""[...document.querySelectorAll("#issue :is(label, input, button)")]
        .map(e => {
            const range = document.createRange();
            range.selectNodeContents(e);
            const {left, top, right, bottom} = e.matches("label")
                ? range.getClientRects()[0] : e.getBoundingClientRect();
            return [left, top, right, bottom];
        })""")
    assert len(boxes) == 11 and all(0 <= left < right <= width for left, _, right, _ in boxes)
    over = [
        (a, b)
        for i, a in enumerate(boxes)
        for b in boxes[i + 1 :]
        if a[0] < b[2] - 1 and b[0] < a[2] - 1 and a[1] < b[3] - 1 and b[1] < a[3] - 1
    ]
    assert over == []  # fmt: skip
    teacher.set_viewport_size({"width": 1280, "height": 900})


def test_a_class_of_five(browser: Any, served: Served, teacher: Any, tmp_path: Path) -> None:
    files = {"base": classroom.base_text().encode(), "roster": roster_book(5)}
    failed = [
        not_issued(teacher, served, files["roster"], "1e3"),
        not_issued(teacher, served, "Кто;Где\nЯ;тут\n".encode("cp1251"), "1"),
    ]
    assert failed[0] == failed[1] == stored(served).name  # one takes the place of another
    teacher.reload()
    teacher.wait_for_selector("#class .bad li")
    teacher.click("#newClass summary")
    teacher.fill("#title", "ДВС-1 <b>")
    for name, data in files.items():
        teacher.set_input_files(f"#{name}", {"name": f"{name}.txt", "mimeType": "", "buffer": data})
    teacher.click("#issue button")
    teacher.wait_for_selector("#links a.own >> nth=4", timeout=WAIT)
    assert "секрет" not in teacher.inner_text("body").lower()  # the server keeps it
    every = zipfile.ZipFile(io.BytesIO(taken(teacher, "a[download='issued.zip']")))
    assert len(every.namelist()) == 5
    links = [a.get_attribute("href") for a in teacher.query_selector_all("#links a.own")]

    # A student takes the own book by the own link and hands it in; nothing else is open.
    register = load_register(stored(served) / "issued")

    def solved(number: int, book: bytes, **changes: Any) -> bytes:
        assignment = assignment_for(register.books[number - 1], register.rubric)
        return filled_book(book, assignment, changes or None, charts=True)

    student = opened(browser, served.page + links[2])
    student.wait_for_selector("#book[href]")
    own = taken(student, "#book")
    issued = {name: every.read(name) for name in every.namelist()}
    assert own in issued.values() and len(set(issued.values())) == 5
    student.set_input_files(
        "#work", {"name": "Моя работа.xlsx", "mimeType": "", "buffer": b"MZ not a workbook"}
    )
    student.wait_for_selector("#errors li")
    assert "Моя работа.xlsx" in student.inner_text("#errors")  # as its owner calls it
    task = student.inner_text("#task")
    titles = {field["key"]: field["title"] for group in groups(register.books[2].raw)
              for entry in group["entries"] for field in entry}  # fmt: skip
    assert len(register.books[2].drawn) > 1
    assert all(titles[key] in task for key in register.books[2].drawn)
    # What the terminal's check says, without a terminal; it is no condition.
    half = solved(3, own, omega=["460,77 рад/с"], lam=[None])
    student.set_input_files("#work", {"name": "р.xlsx", "mimeType": "", "buffer": half})
    until(student, "document.getElementById('state').textContent.includes('работа сдана')")
    remarks = student.inner_text("#remarks").splitlines()
    assert "Массы λ: пусто: Массы!C7" in remarks
    assert any("ω: число записано текстом" in remark for remark in remarks)
    assert axe.faults(student) == []
    assert stored(served).joinpath("works", register.books[2].file).read_bytes() == half
    student.set_input_files("#work", {"name": "р.xlsx", "mimeType": "", "buffer": solved(3, own)})
    until(student, "!document.querySelector('#remarks li')")
    until(student, "/работа сдана \\d/.test(document.getElementById('state').textContent)")
    assert not student.is_visible("#page")
    # What was handed in before is kept, and told; somebody else's book takes nobody's place.
    path = stored(served) / "works" / register.books[2].file
    (before,) = (path.parent / "earlier" / path.stem).iterdir()
    assert before.read_bytes() == half
    until(student, "document.querySelector('#earlier')?.textContent.includes('хранятся')")
    counted, message = path.read_bytes(), student.inner_text("#state")
    for foreign in (next(iter({*issued.values()} - {own})), b"PK\x03\x04 broken"):
        student.set_input_files("#work", {"name": "ч.xlsx", "mimeType": "", "buffer": foreign})
        student.wait_for_selector("#errors li")
        assert path.read_bytes() == counted and student.inner_text("#state") == message
        assert len(list(before.parent.iterdir())) == 1
    student.set_input_files("#work", {"name": "р.xlsx", "mimeType": "", "buffer": counted})
    until(student, "!document.querySelector('#errors li')")
    assert len(list(before.parent.iterdir())) == 1  # the same once more is no other one
    student.reload()
    student.wait_for_selector("#earlier")
    teacher.reload()
    until(teacher, "/сдал здесь \\d.*раньше ещё 1/.test(document.body.textContent)")
    name = stored(served).name
    ask = student.context.request
    assert ask.get(f"{served.page}api/teacher/{name}").status == 403
    payload, _, mark = links[2].removeprefix("s/").rstrip("/").partition(".")
    other = URLSafeSerializer(b"guess", "student").dumps([name, 2]).partition(".")[0]
    assert payload == URLSafeSerializer(b"guess", "student").dumps([name, 3]).partition(".")[0]
    forged = f"{other}.{mark}"  # a neighbour's page under the own mark
    assert ask.get(f"{served.page}api/student/{forged}").status == 404
    assert ask.get(f"{served.page}{links[2].replace('s/', 'api/student/', 1)}page").status == 404

    # The list of links for telephones, codes, counts; what was handed in is there for the teacher.
    assert teacher.inner_text("#links summary").startswith("1 из 5 сдали")
    text = taken(teacher, "#list").decode("utf-8-sig")
    rows = list(csv.DictReader(io.StringIO(text), delimiter=";"))
    assert [row["Ссылка"] for row in rows] == [f"{served.page}{link}" for link in links]
    assert [row["Попыток"] for row in rows] == ["0", "0", "2", "0", "0"] and rows[2]["Сдано"]
    teacher.click(".qr summary >> nth=2")
    until(teacher, "document.querySelectorAll('.qr img')[2].naturalWidth > 100")
    assert taken(teacher, "#links tr:nth-child(3) small a") == half
    # A deadline, and what comes after it.
    teacher.fill("#deadline", "2020-01-02T03:04")
    until(teacher, "document.querySelector('#links').textContent.includes('после срока')")
    student.reload()
    student.wait_for_selector("#earlier")
    assert "срок 2 января 2020" in student.inner_text("#state")
    assert "после срока" in student.inner_text("#state")
    teacher.fill("#deadline", "")
    until(teacher, "!document.querySelector('#links').textContent.includes('после срока')")

    # The others' works come as Moodle's archive, with Moodle's worksheet.
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for number, word, changes in (
            (1, "Иванов_101", {}),
            (2, "Петров_102", {"omega": ["=regime_speed_rpm"]}),
            (4, "Кузнецов_104", UNKNOWN),
        ):
            path = register.books[number - 1]
            book = issued[f"{path.folder}/{path.file}"]
            archive.writestr(
                f"Имя {word}_assignsubmission_file_/р.xlsx", solved(number, book, **changes)
            )
    uploads = teacher.locator("#class input[type=file]")
    uploads.nth(0).set_input_files(
        {"name": "works.zip", "mimeType": "", "buffer": stream.getvalue()}
    )
    until(teacher, "document.querySelector('#class').textContent.includes('works.zip: загружено')")
    for wrong, said in (("moodle.zip", "загрузите архив .zip"), ("worksheet.csv", "не ведомость")):
        message = teacher.context.request.post(
            f"{served.page}api/teacher/{name}/file/{wrong}", data=b"a;b\n1;2\n",
            headers={**MARK, "content-type": "application/octet-stream"},
        )  # fmt: skip
        assert (
            message.status == 422 and said in message.text()
        )  # it would stand in the way for ever
    sheet = ("\ufeff" + worksheet(ENGLISH)).encode()
    uploads.nth(1).set_input_files({"name": "moodle.csv", "mimeType": "", "buffer": sheet})
    until(teacher, "document.querySelector('#class').textContent.includes('moodle.csv: загружено')")
    teacher.click("#grade")
    until(teacher, "document.querySelector('#class [role=status]').textContent.includes('идёт')")
    assert teacher.is_disabled("#grade")
    again = teacher.context.request.post(
        f"{served.page}api/teacher/{name}/grade", data={}, headers=MARK
    )
    assert again.status == 422  # one at a time
    teacher.wait_for_selector("#class [aria-label=Ведомость] table", timeout=WAIT)
    actual = points(teacher)
    assert actual["Иванов"] == actual["Сидорова"] == "100" and actual["Попова"] == ""
    assert 0 < float(actual["Петров"].replace(",", ".")) < 100
    assert float(actual["Кузнецов"].replace(",", ".")) < 100
    waiting = teacher.locator("tr.odd").all_inner_texts()
    assert [row.split()[:2] for row in waiting] == [["4.", "Кузнецов"]]  # a person has to look
    assert teacher.inner_text("#links summary").startswith("4 из 5 сдали")  # three by the archive
    assert axe.faults(teacher) == []
    photo(teacher, "teacher")
    tall = heights(teacher)
    assert len(tall) > 8 and min(tall.values()) >= 44, tall

    # The page of a work, the decision about what the program could not judge, Moodle's file.
    with teacher.expect_popup() as popup:
        teacher.click("[aria-label=Ведомость] a:has-text('Кузнецов')")
    popup.value.wait_for_selector("text=Кузнецов")
    popup.value.close()
    unknown = teacher.locator("[aria-label=Ведомость] tr:has-text('Кузнецов') option").nth(1)
    assert unknown.evaluate("option => option.value") == "geometry.V_c"
    decide(teacher, "Кузнецов", "geometry.V_c", "0,21")
    decide(teacher, "Петров", "всё", "77", remark="=1+1")
    actual = points(teacher)
    assert actual["Петров"] == "77" and actual["Кузнецов"] == "99,99"
    assert not teacher.locator("tr.odd").count()
    assert all("А" <= text[0] <= "Я" for text in teacher.locator("#results a").all_inner_texts())
    for file in ("gradebook.xlsx", "moodle.csv", "moodle-feedback.zip"):
        assert taken(teacher, f"#results a[download='{file}']")
    text = taken(teacher, "#results a[download='moodle-worksheet.csv']").decode("utf-8-sig")
    grades = {line["Identifier"]: line["Grade"] for line in csv.DictReader(io.StringIO(text))}
    assert float(grades["Participant 101"]) == 100
    assert float(grades["Participant 102"]) == 77

    # Students see their own page once it is opened, never another's.
    teacher.check("#open")
    until(teacher, "document.getElementById('open').checked")
    student.reload()
    student.wait_for_selector("#page:not([hidden])")
    assert "баллы: 100" in student.inner_text("#state")
    assert axe.faults(student) == []
    photo(student, "student")
    assert min(heights(student).values()) >= 44
    message = [
        ask.get(f"{served.page}{link.replace('s/', 'api/student/', 1)}").json() for link in links
    ]
    assert [each["handed"] for each in message] == [True] * 4 + [False]  # in Moodle as well as here
    answer = ask.get(f"{served.page}{links[2].replace('s/', 'api/student/', 1)}page")
    assert "Сидорова" in answer.text() and "Петров" not in answer.text()
    assert answer.headers["content-security-policy"].startswith("sandbox")

    # With pages open a later book does not count, unless the teacher allows it.
    door = f"{served.page}{links[2].replace('s/', 'api/student/', 1)}work"
    heads = {**MARK, "content-type": "application/octet-stream"}
    later = solved(3, own)
    assert student.is_visible("#closed") and not student.locator("#work").count()
    assert ask.post(door, data=later, headers=heads).status == 409
    teacher.check("#late")
    until(teacher, "document.getElementById('late').checked && !document.querySelector('.bad li')")
    assert ask.post(door, data=later, headers=heads).status == 200
    assert not teacher.faults
    student.context.close()

    # Nobody is inside after leaving; a class that is deleted is gone, with its works.
    teacher.click("#leave")
    teacher.wait_for_selector("#login")
    assert teacher.context.request.get(f"{served.page}api/teacher").status == 403
    teacher.goto(served.teacher)
    teacher.reload()  # only its hash was another one
    teacher.wait_for_selector("#forget")
    folder = stored(served)
    teacher.on("dialog", lambda dialog: dialog.accept())
    teacher.click("#forget")
    until(teacher, "!document.querySelector('#class')")
    assert not folder.exists()
