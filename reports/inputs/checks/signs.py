"""Signs in a file's texts that the report's font lacks: said before they are printed as □."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.fields import iter_fields
from reports.inputs.findings import Finding
from reports.inputs.sections.input_file import InputFile
from reports.shared.signs import REPLACEMENT, unprintable

_MOST = 5  # signs that are listed one by one


def check_signs(model: InputFile) -> Iterator[Finding]:
    """Yield a warning for every text of the file that cannot be printed as it is."""
    for field in iter_fields(model):
        signs = unprintable(field.value) if isinstance(field.value, str) else ()
        if signs:
            listed = ", ".join(f"{sign} (U+{ord(sign):04X})" for sign in signs[:_MOST])
            more = f" и ещё {len(signs) - _MOST}" if len(signs) > _MOST else ""
            what = f"в шрифте отчёта нет: {listed}{more}"
            hint = f"уберите или замените, иначе напечатается {REPLACEMENT}"
            yield Finding(field.path, what, hint, warning=True)
