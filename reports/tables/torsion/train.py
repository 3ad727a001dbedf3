"""The train of the torsional vibration: inertias, stiffnesses by three formulas, damping.

The three formulas are written from memory of the handbooks named after their authors; what
the file does not give is estimated, and says so.
"""

from __future__ import annotations

from dataclasses import dataclass

from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.torsion import FORMULAS, LEAST_SPEED, MOST_SPEED, TorsionSection
from reports.shared.russian import short
from reports.spec.blocks import Block, Grid, GridRow, Scalar, ScalarTable
from reports.spec.listing import grid_row, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape
from reports.tables.gas.diagram import peak_pressure

SHEET, RESULTS = "Крутильная схема", "Крутильные итоги"
GIVEN, GUESS, MEMORY = "задано", "оценка, без источника", "по памяти, без источника"
_BORE = "2*sqrt(F_piston/pi)"


@dataclass(frozen=True, slots=True)
class Cell:
    """An expression and where it comes from."""

    expr: str
    source: str = GIVEN


@dataclass(frozen=True, slots=True)
class Train:
    """Masses of a train from the nose as expressions; ``throws`` from 1, 0 without rods."""

    labels: tuple[str, ...]
    inertias: tuple[Cell, ...]
    stiffnesses: tuple[Cell, ...]  # behind each mass, of the last one to the ground
    diameters: tuple[str, ...]  # of the shafts between [mm]
    throws: tuple[int, ...]
    is_free: bool
    flywheel: int  # number of its mass from 1
    own: bool  # given mass by mass

    @property
    def count(self) -> int:
        """Number of masses."""
        return len(self.labels)

    @property
    def modes(self) -> range:
        """Numbers of the frequencies that the sheets find, from 1."""
        return range(1, min(3, self.count - self.is_free) + 1)

    def mass_of(self, throw: int) -> int:
        """Number of the mass with a throw, from 1; 0 where there is none."""
        return self.throws.index(throw) + 1 if throw in self.throws else 0


def asked(scope: Scope) -> TorsionSection | None:
    """The section, if the file has it."""
    return scope.input.torsion


def train_of(model: InputFile, shape: Shape) -> Train:
    """The train given, or the equivalent one of the engine."""
    section = model.torsion
    if section is None:
        raise ValueError("no torsional vibration is asked for")
    alike = model.crankshaft.main_diameters_mm is None
    if section.masses:
        return _given(section, 1 if alike else shape.throws + 1)
    return _equivalent(section, shape)


def _given(section: TorsionSection, sizes: int) -> Train:
    """The train of the input; ``sizes`` is how many diameters the journals have."""
    numbers = range(1, len(section.masses) + 1)
    journals = [f"main_diameter_{k}_mm" for k in range(1, sizes + 1)]
    mean = f"total({', '.join(journals)})/{len(journals)}"
    inertias = [mass.inertia_kg_m2 for mass in section.masses]
    return Train(
        tuple(mass.name or f"масса {k}" for k, mass in zip(numbers, section.masses, strict=True)),
        tuple(Cell(f"torsion_mass_{k}_inertia_kg_m2") for k in numbers),
        tuple(Cell(f"torsion_mass_{k}_stiffness_nm_rad") for k in numbers),
        tuple(
            mean if section.masses[k - 1].diameter_mm is None else f"torsion_mass_{k}_diameter_mm"
            for k in numbers[:-1]
        ),
        tuple(int(mass.throw) for mass in section.masses),
        section.ground_nm_rad == 0 and section.masses[-1].stiffness_nm_rad == 0,
        inertias.index(max(inertias)) + 1,
        own=True,
    )


def _equivalent(section: TorsionSection, shape: Shape) -> Train:
    throws, section_of = range(1, shape.throws + 1), "torsion_{}"
    inertias = [
        Cell(f"torsion_throw_{k}_kg_m2") if section.throws_kg_m2 else _throw(k, shape)
        for k in throws
    ]
    own = ", ".join(f"torJ{k + 1}" for k in throws)
    pulley = Cell(section_of.format("pulley_kg_m2"))
    if section.pulley_kg_m2 is None:
        pulley = Cell(f"0.4*total({own})/{shape.throws}", f"{GUESS}: 0,4 колена")
    between = [
        Cell(f"torsion_throw_{k}_nm_rad")
        if section.throws_nm_rad
        else Cell(f"2/(tore{k} + tore{k + 1})", MEMORY)
        for k in throws[:-1]
    ]
    last = shape.throws
    flange = (
        f"of_mm(main_length_{last + 1}_mm)/2/(of_MPa(torsion_shear_modulus_mpa)*pi/32"
        f"*(of_mm(main_diameter_{last + 1}_mm)**4 - of_mm(torsion_main_bore_mm)**4))"
    )
    nose = Cell("torsion_nose_nm_rad") if section.nose_nm_rad else Cell("1/tore1", GUESS)
    rear = (
        Cell("torsion_rear_nm_rad")
        if section.rear_nm_rad
        else Cell(f"1/(tore{last}/2 + {flange})", GUESS)
    )
    labels = ["шкив", *(f"колено {k}" for k in throws), "маховик"]
    masses, springs = [pulley, *inertias, Cell("tor_flywheel", "см. ниже")], [nose, *between, rear]
    diameters = [f"main_diameter_{k}_mm" for k in range(1, last + 2)]
    numbers = [0, *throws, 0]
    if section.driven_kg_m2 is not None:
        labels.append("за маховиком")
        masses.append(Cell("torsion_driven_kg_m2"))
        springs.append(
            Cell("torsion_driven_nm_rad")
            if section.driven_nm_rad
            else Cell(f"torc{len(springs)}", f"{GUESS}: как перед маховиком")
        )
        diameters.append(diameters[-1])
        numbers.append(0)
    springs.append(Cell("0", "конец свободен"))
    return Train(
        tuple(labels), tuple(masses), tuple(springs), tuple(diameters), tuple(numbers),
        section.ground_nm_rad == 0, last + 2, own=False,
    )  # fmt: skip


def _throw(k: int, shape: Shape) -> Cell:
    webs = " + ".join(f"web_{w}_mass_kg + web_{w}_counterweight_kg" for w in (2 * k - 1, 2 * k))
    rods = []
    for cylinder in shape.groups[k - 1]:
        hung = shape.is_hung(cylinder)
        turning = "articulated_big_end_kg" if hung else "m_2"
        moving = "articulated_reciprocating_kg" if hung else "m_j"
        rods.append(f"{turning} + {moving}*(1/2 + lam**2/8)")
    text = f"(crankshaft_pin_mass_kg + {webs} + {' + '.join(rods)})*r_crank**2"
    return Cell(text, "оценка: массы щёк и противовесов на радиусе r")


def train(scope: Scope) -> Part:
    """Sheet of the train."""
    section = asked(scope)
    if section is None:
        return Part()
    found = train_of(scope.input, scope.shape)
    blocks: list[Block] = [_scheme(found, scope.shape, section), _list(found, section, scope)]
    if not found.own:
        blocks.insert(0, _compliances(scope.shape, section))
    if section.peaks:
        blocks.append(_peaks(len(section.peaks)))
    return Part(tuple(blocks))


def _row(of: str, key: str, cells: list[Cell]) -> GridRow:
    return GridRow(
        of,
        tuple(
            Scalar(f"{key}{k}", cell.expr, cell.source, of=of) for k, cell in enumerate(cells, 1)
        ),
    )


def _scheme(train: Train, shape: Shape, section: TorsionSection) -> Grid:
    each = "torsion_damping_nms_rad"
    source = GIVEN
    if section.damping_nms_rad is None:
        each, source = "49200*F_piston*r_crank**2", f"{GUESS}: 49,2·F·r² кН·с/м³, как у дизеля MWM"
    damping = [
        Cell(f"{len(shape.groups[throw - 1])}*{each}", source) if throw else Cell("0", "нет")
        for throw in train.throws
    ]
    hole = "torsion_main_bore_mm"
    moduli = [
        Cell(f"pi*(({d})**4 - {hole}**4)/(16*({d}))/1000", "сопротивление материалов")
        for d in (*train.diameters, train.diameters[-1])
    ]
    note = (
        "Жёсткость — участка за массой, до следующей; за последней массой — до заделки, 0 — конец "
        "свободен. "
    )
    if not train.own:
        note += (
            "Схема приведена к одному валу. Моменты инерции колен — оценка: массы щёк и "
            "противовесов приведены к радиусу r по центробежной силе; вместо неё можно задать "
            "действительные моменты инерции. Средний приведённый момент инерции шатуна и поршня — "
            "m2r² + mjr²(1/2 + λ²/8)."
        )
    return Grid(
        "torsion_train",
        "Крутильная схема вала",
        SHEET,
        train.labels,
        (
            _row("tor_J_kgm2", "torJ", list(train.inertias)),
            _row("tor_c_Nm_rad", "torc", list(train.stiffnesses)),
            _row("tor_W_cm3", "torW", moduli),
            _row("tor_b_Nms_rad", "torb", damping),
        ),
        note=note,
    )


def _compliances(shape: Shape, section: TorsionSection) -> Grid:
    """Twist of every throw under a unit torque by the three formulas."""
    numbers = range(1, shape.throws + 1)
    sizes = [_sizes(k, section, shape.parts) for k in numbers]
    rows = [
        grid_row(f"tor_{key}", (size[key] for size in sizes), source, f"tor{key}{{n}}")
        for key, source in _SIZES.items()
    ]
    rows += [
        grid_row(f"tor_e_{key}", (_LENGTHS[key].format(k=k) for k in numbers),
                 f"{name}, {MEMORY}", f"tore_{key}_{{n}}")
        for key, name in FORMULAS.items()
    ]  # fmt: skip
    chosen = (
        f'tore_wilson_{k} if torsion_formula == "{FORMULAS["wilson"]}" else tore_carter_{k}'
        f' if torsion_formula == "{FORMULAS["carter"]}" else tore_zimanenko_{k}'
        for k in numbers
    )
    return Grid(
        "torsion_compliance",
        "Податливость колен по трём формулам",
        SHEET,
        tuple(f"колено {k}" for k in numbers),
        (*rows, grid_row("tor_e", chosen, "выбор в исходных данных", "tore{n}")),
        note=(
            "Формулы приведённой длины Кер-Вильсона, Картера и Зиманенко записаны по памяти и не "
            "сверены с первоисточником; они расходятся на 10–30 %, поэтому показаны все три."
            + (_PARTS if shape.parts > 1 else "")
        ),
    )


_SIZES = {
    "Dj": "среднее соседних шеек", "Lj": "среднее соседних шеек", "Dp": GIVEN, "Lp": GIVEN,
    "hw": "задано или доля диаметра цилиндра", "bw": "задано или доля диаметра цилиндра",
    "Ij": "сопротивление материалов", "Ip": "сопротивление материалов",
    "Iw": "сопротивление материалов",
}  # fmt: skip


def _sizes(k: int, section: TorsionSection, pins: int) -> dict[str, str]:
    """Sizes of a throw [m] and what they resist to a twist [m⁴] as expressions."""
    left, right = f"throw_{k}_left_web_mm", f"throw_{k}_right_web_mm"
    thickness = "of_mm(torsion_web_thickness_mm)"
    if section.web_thickness_mm is None:
        thickness = (
            f"of_mm(({left} + {right})/2) if {left} + {right} > 0"
            f" else balance_web_thickness_share*{_BORE}"
        )
    width = "of_mm(torsion_web_width_mm)"
    if section.web_width_mm is None:
        width = f"balance_web_width_share*{_BORE}"
    length = f"of_mm(pin_length_{k}_mm)"
    return {
        "Dj": f"of_mm((main_diameter_{k}_mm + main_diameter_{k + 1}_mm)/2)",
        "Lj": f"of_mm((main_length_{k}_mm + main_length_{k + 1}_mm)/2)",
        "Dp": f"of_mm(pin_diameter_{k}_mm)",
        "Lp": length if pins == 1 else f"{pins}*{length}",
        "hw": thickness,
        "bw": width,
        "Ij": f"torDj{k}**4 - of_mm(torsion_main_bore_mm)**4",
        "Ip": f"torDp{k}**4 - of_mm(torsion_pin_bore_mm)**4",
        "Iw": f"torhw{k}*torbw{k}**3",
    }


_PARTS = (
    " Половины шеек сдвинуты: их длины сложены, податливость перехода между ними в формулах "
    "не учтена."
)
_WHOLE = "({})/(of_MPa(torsion_shear_modulus_mpa)*pi/32)"
_LENGTHS = {
    "wilson": _WHOLE.format(
        "(torLj{k} + 0.4*torDj{k})/torIj{k} + (torLp{k} + 0.4*torDp{k})/torIp{k}"
        " + (r_crank - 0.2*(torDj{k} + torDp{k}))/torIw{k}"
    ),
    "carter": _WHOLE.format(
        "(torLj{k} + 0.8*torhw{k})/torIj{k} + 0.75*torLp{k}/torIp{k} + 1.5*r_crank/torIw{k}"
    ),
    "zimanenko": _WHOLE.format(
        "(torLj{k} + 0.6*torhw{k}*torDj{k}/torLj{k})/torIj{k}"
        " + (0.8*torLp{k} + 0.2*torbw{k}*torDj{k}/r_crank)/torIp{k}"
        " + r_crank*sqrt(r_crank/torDp{k})/torIw{k}"
    ),
}


def _list(train: Train, section: TorsionSection, scope: Scope) -> ScalarTable:
    """Flywheels, range of speeds, bound of the frequencies."""
    springs = ["torsion_ground_nm_rad", *(f"torc{k}" for k in range(1, train.count + 1))]
    bounds = ", ".join(
        f"2*({springs[k - 1]} + {springs[k]})/torJ{k}" for k in range(1, train.count + 1)
    )
    return ScalarTable(
        "torsion_list",
        "Маховики и рабочий диапазон",
        SHEET,
        scalar_list(
            *(
                ["tor_greatest = first_largest(torsion_train.tor_J_kgm2) | место наибольшего"]
                if train.own
                else []
            ),
            f"tor_flywheel = {_flywheel(train, section, scope.shape)}",
            _chosen("tor_flywheel_other", "other_flywheel_kg_m2", section, "1.5*tor_flywheel",
                    "в полтора раза тяжелее"),
            _speed("tor_n_min", "speed_min_rpm", section, LEAST_SPEED),
            _speed("tor_n_max", "speed_max_rpm", section, MOST_SPEED),
            f"tor_limit = sqrt(max({bounds})) | теорема Гершгорина",
            *(
                [f"tor_diagram_MPa = {peak_pressure(scope.input)} | индикаторная диаграмма"]
                if section.peaks
                else []
            ),
        ),
    )  # fmt: skip


def _chosen(key: str, given: str, section: TorsionSection, guess: str, words: str) -> str:
    if getattr(section, given) is not None:
        return f"{key} = torsion_{given} | {GIVEN}"
    return f"{key} = {guess} | {GUESS}: {words}"


def _speed(key: str, given: str, section: TorsionSection, share: float) -> str:
    return _chosen(key, given, section, f"{share}*regime_speed_rpm", f"{short(share)} n")


def _flywheel(train: Train, section: TorsionSection, shape: Shape) -> str:
    if train.own:
        return "element(torsion_train.tor_J_kgm2, tor_greatest) | наибольшая масса схемы"
    if section.flywheel_kg_m2 is not None:
        return f"torsion_flywheel_kg_m2 | {GIVEN}"
    share = f"8*total({', '.join(f'torJ{k + 1}' for k in range(1, shape.throws + 1))})"
    if shape.articulated:
        return f"{share} | {GUESS}: 8 моментов инерции колен"
    return (
        f"I_flywheel if I_flywheel > 0 else {share} | оценка: маховик для требуемой "
        "неравномерности; если он не нужен — 8 моментов инерции колен, без источника"
    )


def _peaks(count: int) -> Grid:
    numbers = range(1, count + 1)
    return Grid(
        "torsion_peaks",
        "Наибольшее давление цикла по частоте вращения",
        SHEET,
        tuple(map(str, numbers)),
        (
            grid_row("tor_peak_rpm", (f"torsion_peak_{k}_speed_rpm" for k in numbers), GIVEN,
                     "torpeakn{n}"),
            grid_row("tor_peak_MPa", (f"torsion_peak_{k}_pressure_mpa" for k in numbers), GIVEN,
                     "torpeakp{n}"),
        ),
        note="Момент газовых сил на другой частоте вращения изменён в отношении этих давлений.",
    )  # fmt: skip
