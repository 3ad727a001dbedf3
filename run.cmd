@echo off
rem run test [ARGS]: lint, types, rooms and tests; run bench, docs, fuzz: as in run; run ARGS: kshm ARGS
setlocal
set "ROOT=%~dp0"
rem The window keeps its own code page for what comes after.
for /f "tokens=2 delims=:." %%c in ('chcp') do set "PAGE=%%c"
chcp 65001 >nul
call :main %*
set "CODE=%errorlevel%"
chcp %PAGE% >nul
exit /b %CODE%

:main
set "PYTHONUTF8=1"
set "PYTHONPATH="
set "PYTHONHOME="
set "KSHM_COMMAND=run"
rem The libraries that PDF needs, where docs/first-project.md says to install them.
if not defined WEASYPRINT_DLL_DIRECTORIES if exist "C:\msys64\mingw64\bin" set "WEASYPRINT_DLL_DIRECTORIES=C:\msys64\mingw64\bin"
rem Developers' commands take more packages.
set "PARTS=[serve]"
for %%c in (test bench docs fuzz breaks) do if /i "%~1"=="%%c" set "PARTS=[serve,sweep,dask]"
call :files %*
if "%~1"=="" goto usage
set "VENV=%ROOT%.venv"
set "PY="
rem py takes the newest that is registered; python may be one that is not.
call :try py -3
if not defined PY call :try python
if not defined PY call :try python3
if not defined PY (
  echo Нужен Python 3.11 или новее: winget install Python.Python.3.13 1>&2
  exit /b 3
)
if not exist "%VENV%\Scripts\kshm.exe" goto install
fc /b "%ROOT%pyproject.toml" "%VENV%\kshm-pyproject" >nul 2>nul || goto install
fc /b "%ROOT%constraints.txt" "%VENV%\kshm-constraints" >nul 2>nul || goto install
if exist "%VENV%\kshm-parts-[serve,sweep,dask]" goto ready
if exist "%VENV%\kshm-parts-%PARTS%" goto ready
goto packages

:install
echo Устанавливаю пакеты Python в .venv, это займёт минуту 1>&2
if exist "%VENV%" rmdir /s /q "%VENV%"
%PY% -m venv "%VENV%"
if errorlevel 1 exit /b 3
:packages
set "PIP="%VENV%\Scripts\python.exe" -m pip install --quiet --disable-pip-version-check --constraint "%ROOT%constraints.txt""
if "%PARTS%"=="[serve,sweep,dask]" (
  %PIP% pip 1>&2
  %PIP% --editable "%ROOT%.%PARTS%" --group "%ROOT%pyproject.toml:dev" 1>&2
) else (
  %PIP% --editable "%ROOT%.%PARTS%" 1>&2
)
if errorlevel 1 (
  echo Нет сети или места на диске: не удалось установить пакеты Python; проверьте их и повторите команду. 1>&2
  exit /b 3
)
copy /y "%ROOT%pyproject.toml" "%VENV%\kshm-pyproject" >nul
copy /y "%ROOT%constraints.txt" "%VENV%\kshm-constraints" >nul
echo.>"%VENV%\kshm-parts-%PARTS%"

:ready
rem System parts (pango for PDF, LibreOffice for tests) are a person's task here: kshm doctor names them.
if /i "%~1"=="test" goto test
set "MODULE="
if /i "%~1"=="bench" set "MODULE=tests.bench"
if /i "%~1"=="fuzz" set "MODULE=tests.fuzz"
if /i "%~1"=="breaks" set "MODULE=tests.breaks"
if /i "%~1"=="docs" set "MODULE=tools.manual "%ROOT%docs""
if defined MODULE goto module
"%VENV%\Scripts\kshm.exe" %*
exit /b %errorlevel%

:module
set "ARGS="
:more
shift
if "%~1"=="" goto start
set ARGS=%ARGS% %1
goto more
:start
pushd "%ROOT%"
"%VENV%\Scripts\python.exe" -m %MODULE% %ARGS%
set "FAILED=%errorlevel%"
popd
exit /b %FAILED%

:try
%* -c "import sys; sys.exit(sys.version_info < (3, 11))" >nul 2>nul
if not errorlevel 1 set "PY=%*"
exit /b 0

rem A loop over the arguments by themselves: a bracket in a name would close the list of "for".
:files
if "%~1"=="" exit /b 0
if /i "%~x1"==".parquet" if "%PARTS%"=="[serve]" set "PARTS=[serve,sweep]"
shift
goto files

:usage
echo Использование:
echo   run КОМАНДА [АРГУМЕНТЫ]    команда kshm, например: run build samples\gots-diesel.toml -o out
echo   run --help                 все команды kshm; run КОМАНДА --help — её ключи
echo   run test [ПУТЬ ...]        проверки и тесты
echo   run bench [ИМЯ]            время и память
echo   run docs [--site ПАПКА]    страницы руководства
echo   run fuzz ДВЕРЬ [СЕКУНДЫ]   случайные файлы на входе
echo   run breaks [СЛОВО]         намеренные поломки: видят ли их тесты
exit /b 0

:test
set "FAILED=0"
set "ARGS="
:collect
shift
if "%~1"=="" goto tests
set ARGS=%ARGS% %1
goto collect
:tests
pushd "%ROOT%"
"%VENV%\Scripts\ruff.exe" check . || set "FAILED=1"
"%VENV%\Scripts\ruff.exe" format --check . || set "FAILED=1"
"%VENV%\Scripts\mypy.exe" || set "FAILED=1"
"%VENV%\Scripts\lint-imports.exe" --no-logo --no-cache || set "FAILED=1"
"%VENV%\Scripts\python.exe" -m pytest -n auto --dist loadgroup %ARGS% || set "FAILED=1"
popd
exit /b %FAILED%
