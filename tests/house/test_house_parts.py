"""Errors, resources, progress and the doctor."""

import ast
import builtins
import ctypes
import io
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from reports.shared import doctor, progress, resources
from reports.shared.errors import InputError, KshmError, OutputError, Problem, SystemPartMissing

ROOT = Path(__file__).parents[2]


def test_a_problem_is_one_line():
    assert Problem("a.toml: x", "плохо", "сделайте так").line() == "a.toml: x: плохо; сделайте так"
    assert Problem("", "плохо").line() == "плохо"
    assert Problem("a\nb", "x\t\x1b[31my").line() == "a b: x [31my"
    assert len(Problem("a", "x" * 5000).line()) == 600


def test_exit_codes():
    assert InputError([Problem("a", "b"), Problem("c", "d")]).lines() == ["a: b", "c: d"]
    assert (InputError("x").exit_code, OutputError("x").exit_code) == (2, 2)
    missing = SystemPartMissing("pango", "apt-get install pango", purpose="для PDF")
    assert missing.exit_code == 3
    assert str(missing) == (
        "не найден системный компонент pango (для PDF); установите его: apt-get install pango"
    )
    assert issubclass(SystemPartMissing, KshmError)


def test_the_bundle_comes_before_the_checkout(tmp_path, monkeypatch):
    package = tmp_path / "reports"
    checkout = tmp_path / "samples"
    bundle = package / "_bundle" / "samples"
    monkeypatch.setattr(resources, "_PACKAGE", package)
    with pytest.raises(KshmError, match="установка повреждена: нет папки samples"):
        resources.samples_dir()
    checkout.mkdir()
    assert resources.samples_dir() == checkout
    bundle.mkdir(parents=True)
    assert resources.samples_dir() == bundle


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(
    ("stream", "delay", "visible"),
    [(Terminal, 0.0, True), (Terminal, 60.0, False), (io.StringIO, 0.0, False)],
)
def test_progress_only_for_a_waiting_person(monkeypatch, stream, delay, visible):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(sys, "stderr", stream())
    with progress.Progress("Считаю [b]", delay=delay) as shown:
        if delay == 0 and shown._timer.ident is not None:
            shown._timer.join()
        assert (shown._status is not None) == visible
        shown.step("Пишу [i]книгу")
    assert ("Пишу [i]книгу" in sys.stderr.getvalue()) == visible


def test_doctor_knows_its_parts():
    parts = {part.name: part for part in doctor.check_system()}
    assert list(parts) == ["Python", "шрифты", "pango", "LibreOffice", "python3-uno"]
    assert parts["Python"].ok
    assert parts["шрифты"].ok
    for part in parts.values():
        assert part.ok == (part.install_command == "")
        assert "\n" not in part.line()


def test_doctor_misses_pango(monkeypatch):
    def nothing(name, *args):
        raise OSError(name)

    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(ctypes, "CDLL", nothing)
    assert not doctor.pango_loads()
    part = next(part for part in doctor.check_system() if part.name == "pango")
    assert part.line() == (
        "НЕТ   pango: для PDF не загружается libgobject-2.0, libpango-1.0, libharfbuzz, "
        "libpangoft2-1.0, libfontconfig; sudo apt-get install -y "
        "libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0"
    )


def test_on_windows_pango_is_what_weasyprint_finds(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(doctor, "sys", SimpleNamespace(platform="win32"))
    monkeypatch.setitem(sys.modules, "weasyprint", ModuleType("weasyprint"))
    monkeypatch.setattr(doctor.ctypes, "CDLL", None)
    assert doctor.pango_loads()
    monkeypatch.delitem(sys.modules, "weasyprint")
    (tmp_path / "weasyprint.py").write_text("print('-----')\nraise OSError('pango')\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(SystemPartMissing, match=r"MSYS2 MINGW64: pacman -S"):
        doctor.need_pango()
    assert capsys.readouterr() == ("", "")


def test_doctor_misses_libreoffice(monkeypatch):
    monkeypatch.setattr(doctor.shutil, "which", lambda name: None)
    monkeypatch.setattr(doctor, "_runs", lambda command: False)
    parts = {part.name: part for part in doctor.check_system()}
    for name in ("LibreOffice", "python3-uno"):
        assert not parts[name].ok
        assert not parts[name].required
        assert parts[name].install_command == doctor.install_command("LibreOffice")


@pytest.mark.parametrize(
    "module", ["reports.shared.doctor", "reports.shared.progress", "reports.inputs.load"]
)
def test_imports_stay_light(module):
    code = f"import sys, {module}; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT
    )
    heavy = {"numpy", "matplotlib", "pandas", "weasyprint", "openpyxl", "rich", "tomlkit"}
    assert not heavy & set(done.stdout.split())


@pytest.mark.parametrize(
    ("release", "programs", "command"),
    [
        ({"ID": "debian"}, {"apt-get"}, "sudo apt-get install -y libpango-1.0-0 "),
        ({"ID": "altlinux"}, {"apt-get"}, "sudo apt-get install -y libpango"),
        ({"ID": "redos"}, {"dnf"}, "sudo dnf install -y pango"),
        ({"ID": "alpine"}, {"apk"}, "sudo apk add pango fontconfig"),
        ({}, set(), "менеджер пакетов этой системы не известен: поставьте pango её средствами"),
    ],
)
def test_the_command_is_that_of_the_systems_own_manager(monkeypatch, release, programs, command):
    monkeypatch.setattr(doctor.platform, "freedesktop_os_release", lambda: release)
    monkeypatch.setattr(doctor.shutil, "which", lambda name: name if name in programs else None)
    message = doctor.install_command("pango")
    assert message.startswith(command)
    if "ID" in release and release["ID"] != "debian":
        assert message == command


def test_what_no_user_needs_is_no_failure(monkeypatch):
    """The doctor ends with 0 where only the tests' parts are missing; a command is told once."""
    from click.testing import CliRunner

    from reports.cli import main

    monkeypatch.setattr(doctor.shutil, "which", lambda name: None)
    monkeypatch.setattr(doctor, "_runs", lambda command: False)
    monkeypatch.setattr(doctor, "_missing_libraries", list)
    done = CliRunner().invoke(main, ["doctor"])
    assert done.exit_code == 0, done.output
    assert done.output.count("установить: ") == 1 and " нет  LibreOffice" in done.output


def test_errors_stand_in_two_trees():
    """The solver's and the report engine's; another file raises theirs."""
    homes = {"kshm/errors.py", "reports/shared/errors.py"}
    names = {name for name in vars(builtins) if name.endswith(("Error", "Exception"))}
    names |= {name for home in homes for name in _classes(ROOT / home)}
    elsewhere = [
        f"{path.relative_to(ROOT)}: {name}"
        for folder in ("kshm", "reports")
        for path in (ROOT / folder).rglob("*.py")
        if path.relative_to(ROOT).as_posix() not in homes
        for name, bases in _classes(path).items()
        if bases & names
    ]
    assert elsewhere == []


def _classes(path: Path) -> dict[str, set[str]]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {
        node.name: {base.id for base in node.bases if isinstance(base, ast.Name)}
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
    }
