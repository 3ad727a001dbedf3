"""The `run` script with a ready environment and a pretended system."""

import os
import re
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from tests.browser import BROWSERS

ROOT = Path(__file__).parents[2]
BASH = shutil.which("bash")
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="run.cmd serves Windows")

PANGO_COMMAND = (
    "sudo apt-get update && sudo apt-get install -y "
    "libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0"
)
ALL_LIBRARIES = "libpango-1.0.so.0 libpangoft2-1.0.so.0 libharfbuzz-subset.so.0"


def script(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!{BASH}\n{text}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


class House:
    """A copy of the house whose tools only write down how they were called."""

    def __init__(self, folder):
        self.root = folder / "a house"
        self.bin = folder / "bin"
        self.log = folder / "log"
        self.log.touch()
        self.root.mkdir()
        (self.root / "tools").mkdir()
        for name in ("run", "pyproject.toml", "constraints.txt", "tools/develop.sh"):
            shutil.copy2(ROOT / name, self.root / name)
        given = (ROOT / "run").read_text(encoding="utf-8")
        pretended = given.replace("=/usr/bin/python3\n", f"='{self.bin}/system/python3'\n")
        assert pretended != given  # the system's Python is pretended too
        (self.root / "run").write_text(pretended, encoding="utf-8")
        (self.root / ".ci").mkdir()
        shutil.copy2(ROOT / ".ci/run", self.root / ".ci/run")
        for tool in ("kshm", "ruff", "mypy", "lint-imports"):
            self.tool(self.root / ".venv/bin" / tool)
        self.tool(self.root / ".venv/bin/python")
        self.tool(self.bin / "apt-get")
        self.tool(self.bin / "sudo", 'if [ "$1" = -n ]; then shift; fi; "$@"')
        script(self.bin / "id", "echo 0")
        self.libraries(ALL_LIBRARIES)
        self.stamp()

    def tool(self, path, more="", status=0):
        script(path, f'echo "{path.name} $*" >>"{self.log}"\n{more}\nexit {status}')

    def libraries(self, text):
        script(self.bin / "ldconfig", f"echo {text}")

    def stamp(self):
        parts = f"{self.root}\n".encode()
        for name in ("pyproject.toml", "constraints.txt"):
            parts += (self.root / name).read_bytes()
        total = subprocess.run(["cksum"], input=parts, capture_output=True, check=True).stdout
        (self.root / ".venv/kshm-stamp").write_bytes(total + b"base dev\n")

    def run(self, *args, command="run", **more):
        keep = {"HOME": str(self.root), "PATH": f"{self.bin}:{os.environ['PATH']}"}
        return subprocess.run(
            [BASH, str(self.root / command), *args],
            capture_output=True,
            text=True,
            check=False,
            cwd=self.bin,
            env=keep | more,
            stdin=subprocess.DEVNULL,
        )

    def calls(self):
        lines = [line.rstrip() for line in self.log.read_text().splitlines()]
        return [line for line in lines if line != "python -c"]


@pytest.fixture
def house(tmp_path):
    return House(tmp_path)


def test_arguments_reach_kshm(house):
    done = house.run("build", "a b.toml", "-o", "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert house.calls() == ["kshm build a b.toml -o out"]


def test_both_streams_of_kshm_are_kept(house):
    house.tool(house.root / ".venv/bin/kshm", "echo result; echo message >&2")
    done = house.run("check", "x")
    assert (done.stdout, done.stderr) == ("result\n", "message\n")


def test_a_check_of_the_text_is_heard_where_it_fails(house):
    house.tool(house.root / ".venv/bin/ruff", "echo quiet")
    assert "quiet" not in house.run("test", KSHM_NO_SYSTEM="1").stdout
    house.tool(house.root / ".venv/bin/mypy", "echo message >&2", status=1)
    done = house.run("test", KSHM_NO_SYSTEM="1")
    assert done.stdout.endswith("message\n") and done.returncode == 1


def test_the_lock_is_not_held_while_kshm_works(house):
    lock = f'flock --nonblock "{house.root}" echo free'
    house.tool(house.root / ".venv/bin/kshm", lock)
    assert house.run("build", "x").stdout == "free\n"


def test_the_exit_code_of_kshm_is_kept(house):
    house.tool(house.root / ".venv/bin/kshm", status=2)
    assert house.run("check", "x").returncode == 2


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        ("build x", True),
        ("build x --only pdf", True),
        ("build x --only xlsx", False),
        ("build x --only pdf --only xlsx", True),
        ("build x --only docx --only xlsx", False),
        ("build x --only=html", False),
        ("build --help", False),
        ("validate", True),
        ("validate --only csv", False),
        ("grade a b -o c", False),
        ("grade a b -o c --pdf", True),
        ("check x", False),
        ("new -o pdf", False),
        ("solve x --json -", False),
        ("issue x --roster y -o z", False),
        ("sweep x", False),
    ],
)
def test_pango_is_for_pages_alone(house, arguments, wanted):
    house.libraries("nothing")
    done = house.run(*arguments.split(), KSHM_NO_SYSTEM="1")
    assert (PANGO_COMMAND in done.stderr) == wanted
    assert house.calls() == [f"kshm {arguments}"]


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        ("", "libpango libreoffice chromium libatomic1"),
        ("-k x", "libpango libreoffice chromium libatomic1"),
        ("tests", "libpango libreoffice chromium libatomic1"),
        ("tests/inputs", ""),
        ("tests/inputs/ tests/kshm -k x", ""),
        ("./tests/inputs/test_inputs_files.py::test_one", ""),
        ("tests/referee", "libreoffice"),
        ("tests/inputs tests/document", "libpango libreoffice chromium libatomic1"),
        ("--quick tests/manual", "libpango chromium libatomic1"),
    ],
)
def test_only_what_the_tests_need_is_asked_for(house, arguments, wanted):
    house.libraries("nothing")
    more = {"PATH": f"{house.bin}:/usr/bin:/bin", "KSHM_NO_SYSTEM": "1"}
    said = house.run("test", *arguments.split(), **more).stderr
    machine = {
        "libpango": True,
        "libreoffice": shutil.which("soffice", path="/usr/bin:/bin") is None,
        "chromium": not any(shutil.which(name, path="/usr/bin:/bin") for name in BROWSERS),
        "libatomic1": True,  # as all libraries here
    }
    commands = [line for line in said.splitlines() if "apt-get install -y" in line]
    assert len(commands) <= 1  # one command for all
    collected = {name for name in machine if f" {name}" in "".join(commands)}
    assert collected == {name for name in wanted.split() if machine[name]}


def test_the_noise_of_apt_is_hidden_unless_it_fails_or_is_wanted(house):
    house.libraries("nothing")
    noise = "debconf: delaying package configuration"
    house.tool(house.bin / "apt-get", f"echo '{noise}' >&2")
    assert noise not in house.run("build", "x").stderr
    assert noise in house.run("build", "x", "-v").stderr
    house.tool(house.bin / "apt-get", f"echo '{noise}' >&2", status=100)
    house.tool(house.bin / "sleep", "")  # it tries again: the other program may be done
    assert noise in house.run("build", "x").stderr


def test_without_arguments_it_tells_its_use(house):
    shutil.rmtree(house.root / ".venv")
    done = house.run()
    assert (done.returncode, done.stderr, house.calls()) == (0, "", [])
    assert "Использование:" in done.stdout
    assert "./run build samples/gots-diesel.toml -o out" in done.stdout


@pytest.mark.parametrize("command", ["test", "bench", "docs", "fuzz", "breaks", "build"])
def test_both_scripts_know_the_same_commands(command):
    for name in ("run", "run.cmd"):
        text = (ROOT / name).read_bytes().decode("utf-8")
        assert f"run {command} " in text, name


def test_root_installs_pango_after_an_update(house):
    house.libraries("libpango-1.0.so.0")
    done = house.run("build", "x")
    assert "Устанавливаю системные пакеты (для PDF)" in done.stderr
    quiet = "apt-get -qq -o DPkg::Lock::Timeout=300"
    packages = "libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0"
    assert house.calls() == [
        f"{quiet} update",
        f"{quiet} install -y --no-install-recommends {packages}",
        "kshm build x",
    ]


@pytest.mark.parametrize(("known", "taken"), [(0, BROWSERS[0]), (100, "chromium")])
def test_the_browser_without_a_window_is_taken_where_the_system_has_it(house, known, taken):
    """All are asked for under a PATH where no browser stands."""
    for tool in ("bash", "env", "dirname", "cat", "cksum", "mktemp", "rm", "grep", "sed"):
        (house.bin / tool).symlink_to(shutil.which(tool))
    house.tool(house.bin / "apt-cache", status=known)
    house.run("test", "tests/web", PATH=str(house.bin))
    (call,) = (call for call in house.calls() if "apt-get" in call and "install" in call)
    assert taken in call.split()


def test_sudo_without_a_password_installs(house):
    script(house.bin / "id", "echo 1000")
    house.libraries("nothing")
    house.run("build", "x")
    assert "sudo -n env DEBIAN_FRONTEND=noninteractive apt-get" in house.log.read_text()


def test_sudo_with_a_password_only_tells(house):
    script(house.bin / "id", "echo 1000")
    house.tool(house.bin / "sudo", status=1)
    house.libraries("nothing")
    done = house.run("build", "x")
    assert done.returncode == 0
    assert PANGO_COMMAND in done.stderr
    assert house.calls() == ["sudo -n true", "kshm build x"]


def test_the_system_is_left_alone_on_demand(house):
    house.libraries("nothing")
    done = house.run("build", "x", KSHM_NO_SYSTEM="1")
    assert done.stderr.count(PANGO_COMMAND) == 1
    assert house.calls() == ["kshm build x"]


def test_a_failing_apt_does_not_stop_the_workbook(house):
    house.libraries("nothing")
    script(house.bin / "apt-get", 'case "$*" in *install*) exit 100;; esac')
    done = house.run("build", "x")
    assert "Установить не удалось." in done.stderr
    assert PANGO_COMMAND in done.stderr
    assert house.calls()[-1] == "kshm build x"


def test_compiled_modules_are_kept(house):
    house.tool(house.root / ".venv/bin/kshm", 'echo "${PYTHONDONTWRITEBYTECODE-kept}"')
    assert house.run("check", "x", PYTHONDONTWRITEBYTECODE="1").stdout == "kept\n"


@pytest.mark.parametrize("command", ["doctor", "--help"])
def test_looking_installs_nothing(house, command):
    house.libraries("nothing")
    house.run(command)
    assert house.calls() == [f"kshm {command}"]


def test_the_test_command_runs_all_and_fails_if_one_fails(house):
    done = house.run("test", "-k", "x", KSHM_NO_SYSTEM="1")
    checks = [
        "ruff check .",
        "ruff format --check .",
        "lint-imports --no-logo --no-cache",
        "mypy",
        "python -m pytest -n auto --dist loadgroup --no-loadscope-reorder -k x",
    ]
    # Side by side: in no fixed order.
    assert (done.returncode, sorted(house.calls())) == (0, sorted(checks))
    house.log.write_text("")
    house.run("test", "--quick", KSHM_NO_SYSTEM="1")
    assert (
        "python -m pytest -n auto --dist loadgroup --no-loadscope-reorder -m not slow"
        in house.calls()
    )
    house.log.write_text("")
    house.run("test", "--all", KSHM_NO_SYSTEM="1")
    assert "python -m pytest -n auto --dist loadgroup --no-loadscope-reorder" in house.calls()
    house.log.write_text("")
    house.tool(house.root / ".venv/bin/mypy", status=1)
    assert house.run("test", KSHM_NO_SYSTEM="1").returncode == 1
    assert "python -m pytest -n auto --dist loadgroup --no-loadscope-reorder" in house.calls()


def test_ci_runs_the_test_command(house):
    house.run(command=".ci/run", KSHM_NO_SYSTEM="1", CI="true")
    assert "python -m pytest -n auto --dist loadgroup --no-loadscope-reorder" in house.calls()


@pytest.mark.parametrize("name", ["pyproject.toml", "constraints.txt"])
def test_a_changed_requirement_reinstalls(house, name):
    with (house.root / name).open("a") as stream:
        stream.write("# changed\n")
    broken = 'case "$*" in *version_info*) exit 0;; *ensurepip*) exit 0;; *venv*) exit 7;; esac'
    house.tool(house.bin / "python3", broken)
    done = house.run("build", "x")
    assert done.returncode == 3
    assert "Не удалось создать окружение" in done.stderr
    assert "kshm build x" not in house.calls()


@pytest.mark.parametrize(
    ("arguments", "kept", "extras"),
    [
        ("build x", "", "serve"),
        ("build x", "base", None),
        ("sweep x -o y.parquet", "base", "serve,sweep"),
        ("build x --dask tcp://a:1", "base sweep", "serve,dask,sweep"),
        ("test tests/inputs", "base", "serve,sweep,dask"),
        ("sweep x -o y.parquet", "base dev", None),
    ],
)
def test_only_what_is_asked_for_is_installed(house, arguments, kept, extras):
    """A developer has everything; a part that came once stays."""
    stamp = house.root / ".venv/kshm-stamp"
    stamp.write_text(stamp.read_text().replace("base dev", kept))
    house.run(*arguments.split(), KSHM_NO_SYSTEM="1")
    installs = [call for call in house.calls() if "pip install" in call and "--editable" in call]
    if extras is None:
        assert installs == []
        return
    (call,) = installs
    assert f"--editable {house.root}[{extras}]" in call
    assert (f"--group {house.root}/pyproject.toml:dev" in call) == ("test" in arguments)
    house.log.write_text("")
    house.run(*arguments.split(), KSHM_NO_SYSTEM="1")
    assert not any("pip install" in call for call in house.calls())


def test_variables_of_other_programs_do_not_reach_it(house):
    shown = 'echo "${PYTHONPATH-none} ${PYTHONHOME-none} $KSHM_COMMAND"'
    house.tool(house.root / ".venv/bin/kshm", shown)
    done = house.run("check", "x", PYTHONPATH="/elsewhere", PYTHONHOME="/nowhere")
    assert done.stdout == f'none none "{house.root}/run"\n'  # as it works from here
    done = house.run("check", "x", KSHM_COMMAND="kshm")
    assert done.stdout == "none none kshm\n"


def test_what_the_system_lacks_comes_beside_the_packages(house):
    """Nothing is there: one call of apt for all, and the environment is not told to be ready."""
    house.libraries("nothing")
    (house.root / ".venv/kshm-stamp").unlink()
    python = 'case "$*" in *"pip install"*) exit 7;; esac'
    house.tool(house.bin / "apt-get", "sleep 1")
    built = house.root / ".venv/bin/python"
    house.tool(house.root / "python", python)
    house.tool(
        house.bin / "python3",
        f"""case "$*" in
        *"-m venv"*) mkdir -p "{built.parent}"; cp "{house.root}/python" "{built}";; esac""",
    )
    done = house.run("test", "tests/web")
    assert (done.returncode, (house.root / ".venv/kshm-stamp").exists()) == (3, False)
    assert done.stderr.splitlines()[-1] == (
        "pip остановился: не удалось установить пакеты Python; проверьте сеть и повторите команду "
        "(подробности: ключ -v)."
    )
    called = [call for call in house.calls() if "apt-get" in call or "pip install" in call]
    assert len([call for call in called if "update" in call]) == 1
    assert len([call for call in called if "libpango" in call]) == 1
    assert "pip install" in called[0] or "pip install" in called[1]  # apt is not waited for


@pytest.mark.parametrize(
    ("lacks", "taken"), [("nothing", "system"), ("ensurepip", "other"), ("version_info", "other")]
)
def test_the_systems_python_comes_first(house, lacks, taken):
    """It is the faster one; what cannot make an environment is passed by."""
    (house.root / ".venv/kshm-stamp").unlink()
    refuses = f'case "$*" in *{lacks}*) exit 1;; *"-m venv"*) echo "{{}} taken" >&2; exit 7;; esac'
    house.tool(house.bin / "system/python3", refuses.format("system"))
    house.tool(house.bin / "python3", refuses.format("other").replace(lacks, "nothing"))
    done = house.run("build", "x", KSHM_NO_SYSTEM="1")
    assert (done.returncode, f"{taken} taken" in done.stderr) == (3, True)


def test_an_old_python_is_refused(house):
    (house.root / ".venv/kshm-stamp").unlink()
    for version in ("", ".11", ".12", ".13", ".14"):
        house.tool(house.bin / f"python3{version}", status=1)
    done = house.run("build", "x", KSHM_NO_SYSTEM="1")
    assert done.returncode == 3
    assert "sudo apt-get install -y python3 python3-venv" in done.stderr


def test_no_address_in_the_constraints():
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pinned = [line for line in lines if not line.startswith("#")]
    assert len(pinned) > 40
    for line in pinned:
        name, version = line.split("==")
        assert name
        assert version[0].isdigit()
        assert "/" not in line


def test_windows_script_has_windows_line_ends():
    data = (ROOT / "run.cmd").read_bytes()
    assert data.count(b"\r\n") == data.count(b"\n") > 40


def test_windows_script_is_read_by_its_interpreter():
    lines = (ROOT / "run.cmd").read_text(encoding="utf-8").lower().splitlines()
    labels = {line[1:].strip() for line in lines if re.match(r":\w", line)}
    text = "\n".join(line for line in lines if not line.startswith("rem "))
    assert set(re.findall(r"(?:goto|call) :?(\w+)", text)) <= labels
    # A bracket in a name closes a list of "for" that holds the arguments.
    assert not re.search(r"\(%\*\)", text)
    # The one way out of the whole goes by the window's own code page.
    main = text.index("\n:main\n")
    assert text[:main].rstrip().endswith("chcp %page% >nul\nexit /b %code%")
    assert text.index("'chcp'") < text.index("chcp 65001") and text.count("chcp 65001") == 1
    # Where py is old, python is tried.
    assert re.findall(r"call :try (.*)", text) == ["py -3", "python", "python3"]
    assert not re.search(r"^\s*exit\b(?! /b)", text, re.MULTILINE)


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("OSError: [Errno 28] No space left on device", "На диске нет места: "),
        ("NewConnectionError: Temporary failure in name resolution", "Нет сети: "),
        ("ERROR: No matching distribution found for numpy==9", "Нет пакета, который подходит"),
        ("PermissionError: [Errno 13] Permission denied: 'x'", "Нет прав на папку "),
    ],
)
def test_a_failed_pip_is_one_sentence_with_the_cause_first(house, said, told):
    (house.root / ".venv/kshm-stamp").write_text("")
    broken = f"""case "$*" in *"pip install"*) echo "{said}" >&2; exit 1;; esac"""
    house.tool(house.root / "python", broken)
    built = house.root / ".venv/bin/python"
    making = f"""case "$*" in
        *"-m venv"*) mkdir -p "{built.parent}"; cp "{house.root}/python" "{built}";; esac"""
    for folder in (house.bin / "system", house.bin):
        house.tool(folder / "python3", making)
    done = house.run("check", "x", KSHM_NO_SYSTEM="1")
    assert done.returncode == 3 and done.stderr.splitlines()[-1].startswith(told)
    assert said not in done.stderr
    done = house.run("check", "x", "-v", KSHM_NO_SYSTEM="1")
    assert said in done.stderr
