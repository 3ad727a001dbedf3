"""Crankshaft as a continuous beam against the split scheme: Gots 2.7 and (54)."""

from __future__ import annotations

from reports.spec.blocks import Grid, GridRow, Scalar, TableSpec
from reports.spec.charts import ChartSpec, Series, over_phi
from reports.spec.listing import column_list, grid_row
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, cylinder_table_id

SHAFT, RESULTS = "Неразрезная схема", "Схемы опор"
UNIT = "r_crank*omega**2"
Groups = list[list[tuple[int, str]]]


def continuous(scope: Scope) -> Part:
    """Three-moment equations; for inner supports and rods that pull at undivided pins."""
    shape = scope.shape
    if shape.throws < 2 or shape.split or shape.articulated or scope.forced:
        return Part()
    groups = _groups(shape)
    blocks = (_beam(groups), _pivots(shape.throws), _table(groups, scope.cycle), _compared(shape))
    return Part(blocks, tuple(_chart(k) for k in range(1, shape.throws + 2)))


def _groups(shape: Shape) -> Groups:
    """Cylinders of every throw with the name of the rod's place."""
    places = shape.arrangement
    return [[(c, "b" if places[c - 1].rod_place else "a") for c in group] for group in shape.groups]


def _beam(groups: Groups) -> Grid:
    """Load terms of every span: rods by their coefficients, centrifugal forces by themselves."""
    spans = [_span(i, group) for i, group in enumerate(groups, 1)]
    spans[0] |= _overhang(1, 1)
    spans[-1] |= _overhang(2, len(spans))
    keys = dict.fromkeys(key for span in spans for key in span)
    # The overhangs stand last, whatever the first span has.
    ordered = [*(key for key in keys if not key.startswith("end")), "end_x", "end_y"]
    return Grid(
        "beam",
        "Грузовые члены уравнений трёх моментов",
        RESULTS,
        tuple(f"пролёт {i}" for i in range(1, len(spans) + 1)),
        tuple(GridRow(key, tuple(span.get(key) for span in spans)) for key in ordered),
        note=(
            "Вал — прямая балка постоянной жёсткости при изгибе в обеих плоскостях на жёстких "
            "соосных опорах. Оси вала: x — влево, если смотреть с носка, y — вверх в плоскости "
            "первого колена. Момент положителен, если его создала бы сила вдоль оси на простой "
            "балке. В (54) второй индекс последнего момента прочитан как П (правая опора)."
        ),
    )


def _span(i: int, group: list[tuple[int, str]]) -> dict[str, Scalar]:
    p, length = f"throw{i}_", f"of_mm(throw{i}_length)"
    places = {
        "a": f"of_mm({p}arm_rod)",
        "b": f"of_mm({p}arm_rod2)",
        "pin": f"of_mm({p}arm_pin)",
        "left": f"of_mm({p}arm_left)",
        "right": f"of_mm({p}length - {p}arm_right)",
    }

    def right(at: str) -> str:
        return f"{at}*({length}**2 - {at}**2)/{length}"

    def left(at: str) -> str:
        return f"({length} - {at})*({length}**2 - ({length} - {at})**2)/{length}"

    cells: dict[str, Scalar] = {}
    rods_at = tuple(dict.fromkeys(place for _, place in group))
    for name in (*rods_at, "pin", "left", "right"):
        for side, term in (("A", right), ("B", left)):
            key = f"beam{side}{name}"
            cells[key] = Scalar(f"beam{i}_{side}{name}", term(places[name]), "три момента", of=key)
    spin = f"m_2*{UNIT}"
    for side in "AB":
        rods = " + ".join(f"{spin}*beam{i}_{side}{name}" for _, name in group)
        ups = (
            f"{rods} + {p}C4*beam{i}_{side}pin + ({p}C2 - {p}C1)*beam{i}_{side}left"
            f" + ({p}C6 - {p}C7)*beam{i}_{side}right"
        )
        sides = f"({p}C8 + {p}C14)*beam{i}_{side}left + ({p}C9 + {p}C15)*beam{i}_{side}right"
        for axis, text in (("U", ups), ("L", sides)):
            key = f"beam{side}{axis}"
            cells[key] = Scalar(f"beam{i}_{side}{axis}", text, "центробежные силы", of=key)
    return cells


def _overhang(end: int, throw: int) -> dict[str, Scalar]:
    """Moment of an external counterweight at its end support in shaft axes [N·m]."""
    gamma, p = f"rad(throw_angle_{throw}_deg)", f"throw{throw}_"
    across, along, arm = f"(-{p}C10)", f"{p}C11", "of_mm(crankshaft_nose_arm_mm)"
    if end == 2:
        across, along, arm = f"({p}C12)", f"{p}C13", "of_mm(crankshaft_rear_arm_mm)"
    texts = {
        "end_x": f"-({across}*cos({gamma}) - {along}*sin({gamma}))*{arm}",
        "end_y": f"-({across}*sin({gamma}) + {along}*cos({gamma}))*{arm}",
    }
    return {
        key: Scalar(f"{key}{end}", text, "вынос противовеса", of=key) for key, text in texts.items()
    }


def _pivots(throws: int) -> Grid:
    """Diagonal of the equations after elimination, for every inner support."""
    inner = range(2, throws + 1)
    texts = (
        f"2*of_mm(throw{k - 1}_length + throw{k}_length)"
        + (f" - of_mm(throw{k - 1}_length)**2/pivot{k - 1}" if k > 2 else "")
        for k in inner
    )
    return Grid(
        "pivots",
        "Исключение неизвестных в уравнениях трёх моментов",
        RESULTS,
        tuple(f"опора {k}" for k in inner),
        (grid_row("pivot", texts, "исключение неизвестных", first=2),),
    )


def _table(groups: Groups, rows: tuple[float, ...]) -> TableSpec:
    """Results first, moments by support, then the helpers."""
    throws = len(groups)
    inner = range(2, throws + 1)
    results = column_list(
        "phi_deg",
        *(
            f"Ms{axis}{k}_Nm = {_moment(k, throws, axis)} | Гоц (54)"
            for k in inner
            for axis in "xy"
        ),
        *(line for k in range(1, throws + 2) for line in _reaction(k, throws)),
    )
    helpers = column_list(
        "helpers:",
        *(line for i, group in enumerate(groups, 1) for line in _load_terms(i, group)),
        *(
            f"step{axis}{k} of step_m = ({_known(k, throws, axis)})/pivot{k} | исключение"
            for axis in "xy"
            for k in inner
        ),
    )
    return TableSpec(
        "continuous",
        "Н",
        "Реакции опор неразрезного вала по уравнениям трёх моментов",
        SHAFT,
        (*results, *helpers),
        rows,
        note="К реакциям разрезной схемы добавлены поправки (54) от опорных моментов.",
    )


def _load_terms(i: int, group: list[tuple[int, str]]) -> list[str]:
    """Load terms of a span: centrifugal forces and rods."""
    found = []
    for axis, force in (("U", "K"), ("L", "T")):
        for side in ("A", "B"):
            rods = "".join(
                f" - beam{i}_{side}{name}*of_MPa({cylinder_table_id(c)}.{force}_MPa)*F_piston"
                for c, name in group
            )
            key = f"{side}{axis}"
            found.append(f"load{i}_{key} of load_{key} = beam{i}_{key}{rods} | грузовой член")
    return found


def _known(k: int, throws: int, axis: str) -> str:
    """Right side of the equation of an inner support, those before it eliminated."""
    text = f"-({_turned(k - 1, 'A', axis)} + {_turned(k, 'B', axis)})"
    if k == 2:
        text += f" - of_mm(throw1_length)*end_{axis}1"
    if k == throws:
        text += f" - of_mm(throw{throws}_length)*end_{axis}2"
    return text if k == 2 else f"{text} - of_mm(throw{k - 1}_length)*step{axis}{k - 1}"


def _moment(k: int, throws: int, axis: str) -> str:
    after = f" - of_mm(throw{k}_length)/pivot{k}*Ms{axis}{k + 1}_Nm" if k < throws else ""
    return f"step{axis}{k}{after}"


def _reaction(k: int, throws: int) -> list[str]:
    parts = [
        f"Rc{axis}{k}_MPa = P4_3_{k}.R{axis}_MPa + to_MPa(({extra})/F_piston) | Гоц (54), (55)"
        for axis in "xy"
        for extra in (_correction(k, throws, axis),)
    ]
    return [*parts, f"Rc{k}_MPa = sqrt(Rcx{k}_MPa**2 + Rcy{k}_MPa**2) | Гоц (59)"]


def _turned(throw: int, side: str, axis: str) -> str:
    """Load term of a span in an axis of the shaft."""
    gamma = f"rad(throw_angle_{throw}_deg)"
    left, up = f"load{throw}_{side}L", f"load{throw}_{side}U"
    if axis == "x":
        return f"{left}*cos({gamma}) - {up}*sin({gamma})"
    return f"{left}*sin({gamma}) + {up}*cos({gamma})"


def _correction(k: int, throws: int, axis: str) -> str:
    """What the inner support moments add to a support's reaction [N], Gots (54)."""

    def moment(support: int) -> str:
        return f"Ms{axis}{support}_Nm" if 2 <= support <= throws else "0"

    parts = []
    if k > 1:
        parts.append(f"-({moment(k - 1)} - {moment(k)})/of_mm(throw{k - 1}_length)")
    if k <= throws:
        parts.append(f"-({moment(k + 1)} - {moment(k)})/of_mm(throw{k}_length)")
    return " + ".join(f"({part})" for part in parts)


def _compared(shape: Shape) -> Grid:
    """Both schemes side by side for every support."""
    numbers = range(1, shape.throws + 2)
    projected = "(of_mm(main_diameter_{k}_mm)*of_mm(main_length_{k}_mm))"

    def row(of: str, text: str, source: str) -> GridRow:
        name, _, kind = of.partition("_")
        texts = (text.format(k=k) for k in numbers)
        return grid_row(of, texts, source, f"{name}{{n}}_{kind}")

    rows = []
    for kind in ("mean", "max"):
        rows += [
            row(f"Rsplit_{kind}", f"Rmain{{k}}_{kind}", "разрезная схема"),
            row(f"Rc_{kind}", f"col_{kind}(continuous.Rc{{k}}_MPa)", "Гоц (54)"),
            row(
                f"dRc_{kind}",
                f"0 if round(Rmain{{k}}_{kind}, 9) == 0 else"
                f" (Rc{{k}}_{kind}/Rmain{{k}}_{kind} - 1)*100",
                "сравнение",
            ),
        ]
    rows.append(row("qc_max", f"Rc{{k}}_max*F_piston/{projected}", "Гоц, 2.6"))
    labels = tuple(f"опора {k}" for k in numbers)
    return Grid("schemes", "Разрезная и неразрезная схемы", RESULTS, labels, tuple(rows))


def _chart(k: int) -> ChartSpec:
    x = "continuous.phi_deg"
    return over_phi(
        f"continuous_{k}", SHAFT, f"Опора {k}: разрезная и неразрезная схемы", "R, МПа",
        Series(x, f"P4_3_{k}.R_MPa", "разрезная"),
        Series(x, f"continuous.Rc{k}_MPa", "неразрезная"),
        caption=f"Реакция опоры {k} по двум схемам",
    )  # fmt: skip
