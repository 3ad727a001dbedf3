"""Check the parts of the system and name the command that installs a missing one."""

from __future__ import annotations

import ctypes
import importlib
import importlib.util
import io
import platform
import shutil
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

from reports.shared.errors import SystemPartMissing

MIN_PYTHON = (3, 11)
_PANGO_DEBIAN = "libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0"
_OFFICE_DEBIAN = "libreoffice-calc-nogui python3-uno poppler-utils"
# Managers of packages: how they install, and the parts.  ALT has apt-get too, with other names.
_MANAGERS = {
    "alt": {"": "apt-get install -y", "pango": "libpango", "LibreOffice": "LibreOffice",
            "Python": "python3"},
    "apt-get": {"": "apt-get install -y", "pango": _PANGO_DEBIAN, "LibreOffice": _OFFICE_DEBIAN,
                "Python": "python3 python3-venv"},
    "dnf": {"": "dnf install -y", "pango": "pango", "Python": "python3",
            "LibreOffice": "libreoffice-calc libreoffice-pyuno"},
    "apk": {"": "apk add", "pango": "pango fontconfig", "LibreOffice": "libreoffice",
            "Python": "python3"},
    "zypper": {"": "zypper install -y", "pango": "libpango-1_0-0", "LibreOffice":
               "libreoffice-calc", "Python": "python311"},
    "pacman": {"": "pacman -S", "pango": "pango", "LibreOffice": "libreoffice-fresh",
               "Python": "python"},
}  # fmt: skip
_PANGO = ("libgobject-2.0", "libpango-1.0", "libharfbuzz", "libpangoft2-1.0", "libfontconfig")
_FONTS = (
    "STIXGeneral.ttf",
    "STIXGeneralBol.ttf",
    "STIXGeneralItalic.ttf",
    "STIXGeneralBolIta.ttf",
)


@dataclass(frozen=True, slots=True)
class SystemPart:
    """One part of the system.

    Attributes:
        name: Russian name.
        ok: It is there and works.
        detail: What was found, or what is missing it for.
        install_command: The command that installs it, empty if it is there.
        required: Without it `kshm build` cannot make everything.
    """

    name: str
    ok: bool
    detail: str
    install_command: str = ""
    required: bool = True

    def line(self) -> str:
        """Return the Russian line `kshm doctor` prints."""
        mark = "есть" if self.ok else "НЕТ " if self.required else "нет "
        text = f"{mark}  {self.name}: {self.detail}"
        return text if self.ok or not self.install_command else f"{text}; {self.install_command}"


def check_system() -> list[SystemPart]:
    """Return every part, present or missing, in the order to show."""
    return [_python(), _fonts(), _pango(), _office(), _uno()]


def need_pango() -> None:
    """Refuse a PDF where pango is not there.

    Raises:
        SystemPartMissing: pango is not on this machine.
    """
    if not pango_loads():
        raise SystemPartMissing("pango", _pango_command(), purpose="нужен для PDF")


def need_packages(purpose: str, **packages: str) -> None:
    """Refuse a document whose packages are not here.

    Args:
        purpose: what they are needed for.
        packages: names of the modules with those by which they are installed.

    Raises:
        SystemPartMissing: some of them are missing.
    """
    missing = [
        package for name, package in packages.items() if importlib.util.find_spec(name) is None
    ]
    if missing:
        command = f'"{sys.executable}" -m pip install {" ".join(missing)}'
        raise SystemPartMissing(", ".join(missing), command, purpose=purpose)


def pango_loads() -> bool:
    """Tell whether the libraries WeasyPrint needs can be loaded."""
    return not _missing_libraries()


def _python() -> SystemPart:
    version = ".".join(str(part) for part in sys.version_info[:3])
    ok = sys.version_info >= MIN_PYTHON
    command = "" if ok else install_command("Python")
    return SystemPart("Python", ok, f"{version}, нужен 3.11 или новее", command)


def _fonts() -> SystemPart:
    # The package is found without importing it: matplotlib takes half a second.
    spec = importlib.util.find_spec("matplotlib")
    folders = list(spec.submodule_search_locations or ()) if spec is not None else []
    folder = Path(folders[0], "mpl-data", "fonts", "ttf") if folders else None
    missing = [name for name in _FONTS if folder is None or not (folder / name).is_file()]
    detail = "нет " + ", ".join(missing) if missing else "STIXGeneral из matplotlib"
    command = f'"{sys.executable}" -m pip install --force-reinstall matplotlib' if missing else ""
    return SystemPart("шрифты", not missing, detail, command)


def _pango() -> SystemPart:
    missing = _missing_libraries()
    if not missing:
        return SystemPart("pango", True, "библиотеки для PDF загружаются")
    detail = f"для PDF не загружается {', '.join(missing)}"
    return SystemPart("pango", False, detail, _pango_command())


def _pango_command() -> str:
    if sys.platform == "win32":
        return (
            "winget install MSYS2.MSYS2, затем в окне MSYS2 MINGW64: "
            "pacman -S mingw-w64-x86_64-pango (по шагам — docs/first-project.md)"
        )
    return "brew install pango" if sys.platform == "darwin" else install_command("pango")


def install_command(part: str) -> str:
    """Command of this system's package manager that installs a part; words where none is known."""
    try:
        release = platform.freedesktop_os_release()
    except OSError:
        release = {}
    family = f"{release.get('ID', '')} {release.get('ID_LIKE', '')}"
    is_alt = "altlinux" in family
    for name, parts in _MANAGERS.items():
        if is_alt if name == "alt" else shutil.which(name):
            return f"sudo {parts['']} {parts[part]}"
    return f"менеджер пакетов этой системы не известен: поставьте {part} её средствами"


def _missing_libraries() -> list[str]:
    if sys.platform == "win32":
        # Windows looks neither in PATH nor in the folders of MSYS2, which WeasyPrint adds;
        # what it misses it prints.
        try:
            with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
                importlib.import_module("weasyprint")
        except OSError:
            return [*_PANGO]
        return []
    return [name for name in _PANGO if not any(_loads(file) for file in _file_names(name))]


def _file_names(name: str) -> tuple[str, ...]:
    # The names WeasyPrint tries; fontconfig and harfbuzz have other version numbers.
    version = "1" if name == "libfontconfig" else "0"
    return (f"{name}-{version}", f"{name}.so.{version}", f"{name}.{version}.dylib", f"{name}.dylib")


def _loads(file: str) -> bool:
    try:
        ctypes.CDLL(file)
    except OSError:
        return False
    return True


def _office() -> SystemPart:
    program = shutil.which("soffice") or shutil.which("libreoffice")
    command = "" if program else install_command("LibreOffice")
    detail = program or "нужен только для сверки книги в тестах"
    return SystemPart("LibreOffice", program is not None, detail, command, required=False)


def _uno() -> SystemPart:
    # python3-uno belongs to the system's Python, not to this one.
    python = "/usr/bin/python3"
    ok = Path(python).exists() and _runs([python, "-c", "import uno"])
    detail = "есть у системного Python" if ok else "нужен только для сверки книги в тестах"
    return SystemPart(
        "python3-uno", ok, detail, "" if ok else install_command("LibreOffice"), required=False
    )


def _runs(command: list[str]) -> bool:
    try:
        done = subprocess.run(command, capture_output=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0
