# The developers' half of ./run, which reads it.
# ./run test [ARGS]   lint, types, rooms and tests (ARGS go to pytest)
# ./run test --quick  the same with the quick tests alone
# ./run test --all    every comparison on every sample (see tests/cover.py)
# ./run bench [NAME]  times and memory (see tests/bench)
# ./run fuzz DOOR [SECONDS]  random files at the doors (see tests/fuzz)
# ./run breaks [WORD]  deliberate breaks and whether the tests see them (see tests/breaks)
# ./run audit         known holes in the pinned packages (asks the index of packages)
# ./run renew         write anew what is generated: golden books, public names, snapshots, docs
# ./run docs [ARGS]   renew the generated pages of docs/, check links (--site DIR: HTML)

office_packages="libreoffice-calc-nogui libreoffice-writer-nogui libreoffice-math-nogui python3-uno poppler-utils gnumeric"
# Chromium without a window takes a quarter less time (tests/browser.py); not every system has it.
browser=chromium-headless-shell

has_office() {
    local program
    program=$(command -v soffice || command -v libreoffice) || return 1
    # LibreOffice may be there without Calc, Writer or Math.
    program=$(dirname "$(readlink -f "$program")")
    [ -e "$program/libsclo.so" ] && [ -e "$program/libswlo.so" ] && [ -e "$program/libsmlo.so" ] || return 1
    command -v ssconvert >/dev/null 2>&1 && command -v pdftoppm >/dev/null 2>&1 &&
        /usr/bin/python3 -c "import uno" 2>/dev/null
}
need_office() { has_office || lacking "для сверки книг в тестах" $office_packages; }
need_browser() {
    local name found=0
    for name in "$browser" chromium chromium-browser; do
        if command -v "$name" >/dev/null 2>&1; then found=1; fi
    done
    [ "$found" = 1 ] || lacking "для проверки страниц HTML в тестах" "$browser"
    # What drives it has a node of its own, which needs this.
    has_library libatomic.so.1 || lacking "для управления браузером" libatomic1
}
# packages_here PACKAGE...: names that this system has, once its lists are new.
packages_here() {
    apt-cache show "$browser" >/dev/null 2>&1 || set -- "${@/#$browser/chromium}"
    printf '%s ' "$@"
}
need_node() {
    command -v npx >/dev/null 2>&1 ||
        lacking "для проверки файлов чужими программами в тестах" nodejs npm
}

need_atheris() {
    # Where there is no wheel of it, inputs are changed blindly.
    "$venv/bin/python" -c 'import atheris' 2>/dev/null && return 0
    pip_install "atheris>=3" || say "Нет пакета atheris: входы будут меняться вслепую."
}

# Packages are audited as they are pinned, without installing them.
audit() {
    "$venv/bin/python" -c 'import pip_audit' 2>/dev/null || pip_install "pip-audit>=2.10" ||
        die "Не удалось установить pip-audit: проверьте сеть и повторите."
    exec "$venv/bin/python" -m pip_audit --requirement "$root/constraints.txt" --no-deps --disable-pip --strict "$@"
}

# What follows from the code and is stored: looked at in the difference, never edited.
renew() {
    "$venv/bin/python" -m tests.workbook.golden --renew
    "$venv/bin/python" -m tests.api.public_names >"$root/names.new"
    mv "$root/names.new" "$root/tests/api/names.txt"
    "$venv/bin/python" -m tools.manual "$root/docs"
    exec "$venv/bin/python" -m pytest -q -p no:cacheprovider tests/inputs --snapshot-update
}

lint() {
    local failed=0
    "$venv/bin/ruff" check . || failed=1
    "$venv/bin/ruff" format --check . || failed=1
    "$venv/bin/lint-imports" --no-logo --no-cache || failed=1
    "$venv/bin/mypy" || failed=1
    return "$failed"
}

run_tests() {
    local failed=0 said checks
    cd "$root"
    case "${1:-}" in
        --quick) shift; export KSHM_QUICK=1; set -- -m "not slow" "$@" ;;
        --all) shift; export KSHM_ALL=1 ;;
    esac
    # The checks of the text run beside the tests and are heard only where they fail: pytest's
    # summary is the last line of a good run.
    said=$(mktemp)
    lint >"$said" 2>&1 &
    checks=$!
    system_ready
    "$venv/bin/python" -m pytest -n auto --dist loadgroup --no-loadscope-reorder "$@" || failed=1
    if ! wait "$checks"; then cat "$said"; failed=1; fi
    rm -f "$said"
    exit "$failed"
}

# What the folders of tests need beyond Python.
office_tests="tests/referee tests/tables tests/workbook tests/grading tests/document tests/studies tests/word tests/sheet tests/torsion"
node_tests="tests/referee tests/workbook tests/word tests/web"
browser_tests="tests/document tests/studies tests/manual tests/web"
pango_tests="tests/document tests/grading tests/studies tests/manual tests/word tests/sheet tests/web"

# tests_want FOLDERS ARGS: whether the tests asked for lie in one of the folders; all without a path.
tests_want() {
    local folders=$1 argument folder path any=no
    shift
    for argument in "$@"; do
        path=${argument%%::*}
        path=${path#"$root"/}
        path=${path#./}
        path=${path%/}
        case "$path" in tests | tests/*) any=yes ;; *) continue ;; esac
        [ "$path" != tests ] || return 0
        for folder in $folders; do
            case "$path/" in "$folder"/*) return 0 ;; esac
        done
    done
    [ "$any" = no ]
}

develop() {
    local command=$1
    shift
    unset KSHM_COMMAND
    lock
    if [ "$command" = test ]; then
        if tests_want "$pango_tests" "$@"; then need_pango; fi
        if tests_want "$office_tests" "$@"; then need_office; fi
        if tests_want "$node_tests" "$@"; then need_node; fi
        if tests_want "$browser_tests" "$@"; then need_browser; fi
    else
        need_pango
    fi
    install base dev
    unlock
    [ "$command" = test ] || system_ready
    cd "$root"
    case "$command" in
        test) run_tests "$@" ;;
        audit) audit "$@" ;;
        renew) renew ;;
        fuzz) need_atheris; exec "$venv/bin/python" -m tests.fuzz "$@" ;;
        docs) exec "$venv/bin/python" -m tools.manual "$root/docs" "$@" ;;
        *) exec "$venv/bin/python" -m "tests.$command" "$@" ;;
    esac
}
