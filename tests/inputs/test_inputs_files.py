"""Files that are no TOML at all, or not quite."""

import errno
import pathlib

import pytest

from reports.inputs.load import load_text, load_toml
from reports.inputs.source import MAX_BYTES
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir

TEXT = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
CUT = "файл обрывается на середине записи; восстановите его конец"
START = "заготовку даст команда «kshm new»"
OTHER = "а нужен текст TOML; выберите другой файл"


def swap(old, new):
    assert TEXT.count(old) == 1
    return TEXT.replace(old, new).encode()


ROW = TEXT[: TEXT.index("bore_mm = 88.0")].count("\n") + 1
LAST = TEXT.count("\n") + 1
CASES = {
    "empty": (b"", f"файл пуст; {START}"),
    "blank": (b" \n\n", f"файл пуст; {START}"),
    "comment only": ("# ничего\n".encode(), f"файл пуст; {START}"),
    "binary": (b"\x00\x01\x02", f"двоичный файл, {OTHER}"),
    "workbook": (b"PK\x03\x04....", f"это книга Excel или архив, {OTHER}"),
    "office": (b"\xd0\xcf\x11\xe0....", f"это старый или зашифрованный документ Office, {OTHER}"),
    "pdf": (b"%PDF-1.7", f"это документ PDF, {OTHER}"),
    "utf-16": ("[report]".encode("utf-16"), "кодировка UTF-16; сохраните файл в UTF-8"),
    "cp1251": (
        '[report]\nstudent = "Иванов"\n'.encode("cp1251"),
        "строка 2: не UTF-8 (возможно, Windows-1251); сохраните файл в UTF-8",
    ),
    "too large": (b"#" * (MAX_BYTES + 1), "файл больше 2 МБ; это не файл исходных данных"),
    "too many lines": (
        b"\n" * 30_000 + b"a=1",
        "в файле больше 20000 строк; это не файл исходных данных",
    ),
    "cut within a letter": (
        "# я".encode()[:-1],
        "файл обрывается посреди знака; восстановите его конец",
    ),
    "cut within a value": (TEXT[: TEXT.index("88.0")].encode(), CUT),
    "cut within a list": (TEXT[: TEXT.index("240, 480]")].encode(), CUT),
    "cut within a key": (TEXT[: TEXT.index("_mm = 88.0")].encode(), CUT),
    "decimal comma": (
        swap("bore_mm = 88.0", "bore_mm = 88,0"),
        f"строка {ROW}, столбец 13: лишние символы после значения; "
        "десятичный разделитель — точка, а не запятая",
    ),
    "no equals sign": (
        swap("bore_mm = 88.0", "bore_mm 88.0"),
        f"строка {ROW}, столбец 9: после ключа нет знака «=»; строка: «bore_mm 88.0»",
    ),
    "key twice": (
        swap("bore_mm = 88.0", "bore_mm = 88.0\nbore_mm = 1"),
        f"строка {ROW + 1}, столбец 12: ключ задан дважды; строка: «bore_mm = 1»",
    ),
    "section twice": (
        (TEXT + "[regime]\n").encode(),
        f"строка {LAST}, столбец 8: раздел задан дважды; строка: «[regime]»",
    ),
    "open quote": (
        b'[report]\nstudent = "abc\n',
        'строка 2, столбец 15: строка не закрыта кавычкой; строка: «student = "abc»',
    ),
    "brackets without end": (
        b"a = " + b"[" * 100_000,
        "слишком глубокая вложенность; уберите лишние скобки",
    ),
    "dotted key without end": (
        b".".join([b"a"] * 100_000) + b" = 1",
        "строка 1: слишком длинный составной ключ; ключ состоит из одного слова",
    ),
    "digits without end": (
        b"a = " + b"9" * 5000,
        "ошибка записи TOML; проверьте запись по примеру из «kshm new»",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_refused_with_one_line(case, tmp_path):
    data, message = CASES[case]
    file = tmp_path / "x.toml"
    file.write_bytes(data)
    with pytest.raises(InputError) as caught:
        load_toml(file)
    assert caught.value.lines() == [f"x.toml: {message}"]


@pytest.mark.parametrize(
    "change", [lambda text: "\ufeff" + text, lambda text: text.replace("\n", "\r\n")]
)
def test_notepad_files_are_read(change, tmp_path):
    file = tmp_path / "x.toml"
    file.write_bytes(change(TEXT).encode())
    assert load_toml(file).model == load_text(TEXT, source="x").model


def test_every_truncation_is_refused_or_valid(tmp_path):
    data = TEXT.encode()
    complete = data.rindex(b"l5_mm")
    file = tmp_path / "x.toml"
    for end in range(0, complete, 37):
        file.write_bytes(data[:end])
        with pytest.raises(InputError) as caught:
            load_toml(file)
        assert all(line.startswith("x.toml: ") for line in caught.value.lines())


def test_long_line_of_points_is_no_bomb():
    points = [[0.0, 0.1]] + [[i / 2, 0.1 + 1e-5 * i] for i in range(1, 1440)] + [[720.0, 0.1]]
    head, rest = TEXT.split("[gas]")
    tail = rest[rest.index("[masses]") :]
    text = f'{head}[gas]\nsource = "table"\npoints = {points}\n{tail}'
    assert len(load_text(text, source="x").model.gas.points) == 1441


def test_no_file(tmp_path):
    with pytest.raises(InputError) as caught:
        load_toml(tmp_path / "none.toml")
    assert caught.value.lines() == [
        f"{tmp_path / 'none.toml'}: файл не найден; проверьте имя и путь"
    ]


def test_folder(tmp_path):
    with pytest.raises(InputError, match="это папка, а нужен файл"):
        load_toml(tmp_path)


def test_file_name_stays_on_one_line(tmp_path):
    file = tmp_path / "a\nb.toml"
    file.write_text("x")
    with pytest.raises(InputError) as caught:
        load_toml(file)
    assert len(str(caught.value).splitlines()) == 1
    assert caught.value.lines()[0].startswith("a b.toml: ")


def test_unreadable(tmp_path, monkeypatch):
    file = tmp_path / "x.toml"
    file.write_text(TEXT, encoding="utf-8")

    def refuse(*args, **kwargs):
        raise PermissionError(errno.EACCES, "denied")

    monkeypatch.setattr(pathlib.Path, "open", refuse)
    with pytest.raises(InputError, match="файл не читается: нет прав"):
        load_toml(file)
