"""Sheet of masses: three masses, weighing, swinging, table 4, reduction of webs, Gots 2.2.

What the input does not give stands here as a formula; ``mass_stand_ins`` names the inputs that
it replaces in the other sheets.
"""

from __future__ import annotations

from kshm.engine.usual import SMALL_END_SHARE
from kshm.mechanics.rod_masses import BORES, PISTON, ROD, STROKE_BORE, THROW
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.masses import PIN_SHARE, ROD_SHARE, to_estimate
from reports.inputs.units import number_text
from reports.spec.blocks import Scalar, ScalarTable
from reports.spec.judged import NO, YES
from reports.spec.listing import scalar_list
from reports.spec.parts import Part, Scope

SHEET = "Массы шатуна"
_BORE = "2*sqrt(F_piston/pi)"
_SPAN = "…".join(map(number_text, SMALL_END_SHARE))
USUAL_SHARE = f"доля массы шатуна на поршневом пальце {_SPAN}"


def mass_stand_ins(model: InputFile) -> dict[str, str]:
    """Input name → scalar of this sheet that takes its place."""
    given, names = model.masses, {}
    if given.reciprocating_kg is None:
        if given.rod_centre_mm is None and given.rod_small_end_share is None:
            names["masses_rod_small_end_share"] = "rod_share"
        if given.piston_group_kg is None:
            names["masses_piston_group_kg"] = "m_piston"
        if given.rod_kg is None:
            names["masses_rod_kg"] = "m_rod"
    if model.crankshaft.pin_mass_kg is None:
        names["crankshaft_pin_mass_kg"] = "pin_est"
    for number, web in enumerate(model.crankshaft.webs, 1):
        if web.actual_mass_kg is not None:
            names[f"web_{number}_mass_kg"] = f"web_red{number}"
        elif web.mass_kg is None:
            names[f"web_{number}_mass_kg"] = "web_est"
    return names


def masses(scope: Scope) -> Part:
    """All blocks of the sheet that apply to the input."""
    blocks = (find(scope.input) for find in (_estimate, _rod, _three, _webs, _specific))
    return Part(tuple(block for block in blocks if block is not None and block.scalars))


def _estimate(model: InputFile) -> ScalarTable | None:
    """Table 4 between its bounds, for what is not given."""
    estimate = to_estimate(model.masses)
    if estimate is None:
        return None
    fuel, (least, most) = estimate.fuel, BORES[estimate.fuel]
    slender_low, slender_high = STROKE_BORE

    def place(value: str, low: float, high: float) -> str:
        return f"min(1, max(0, ({value} - {low:g})/({high:g} - {low:g})))"

    def near(key: str, bounds: tuple[float, float], at: str, own: float | None) -> Scalar:
        low, high = bounds
        name = f"masses_estimate_{key}_kg_per_m2"
        text = f"{low:g} + ({high:g} - {low:g})*{at}" if own is None else name
        return Scalar(f"est_{key}", text, "Гоц, табл. 4" if own is None else "задано")

    scalars = [
        Scalar("est_size", place(f"1000*{_BORE}", 1000 * least, 1000 * most), "Гоц, табл. 4, *"),
        Scalar(
            "est_slender",
            place(f"S_stroke/({_BORE})", slender_low, slender_high),
            "Гоц, табл. 4, **",
        ),
        near("piston", PISTON[estimate.piston_material, fuel], "est_size",
             estimate.piston_area_mass),
        near("rod", ROD[fuel], "est_slender", estimate.rod_area_mass),
        near("throw", THROW[estimate.shaft, fuel], "est_size", estimate.throw_area_mass),
    ]  # fmt: skip
    given = model.masses
    if given.reciprocating_kg is None and given.piston_group_kg is None:
        scalars.append(Scalar("m_piston", "est_piston*F_piston", "Гоц, 2.2, 2.9"))
    if given.reciprocating_kg is None and given.rod_kg is None:
        scalars.append(Scalar("m_rod", "est_rod*F_piston", "Гоц, 2.2, 2.9"))
    share = "masses_estimate_pin_share" if given.estimate_pin_share is not None else f"{PIN_SHARE}"
    scalars.append(Scalar("m_throw_est", "est_throw*F_piston", "Гоц, 2.2, 2.9"))
    if model.crankshaft.pin_mass_kg is None:
        scalars.append(Scalar("pin_est", f"m_throw_est*{share}", "Гоц (28)"))
    if any(web.mass_kg is None and web.actual_mass_kg is None for web in model.crankshaft.webs):
        scalars.append(Scalar("web_est", f"m_throw_est*(1 - {share})/2", "Гоц (28)"))
    return ScalarTable(
        "mass_estimate",
        "ОЦЕНКА масс по таблице 4 учебника",
        SHEET,
        tuple(scalars),
        note=(
            "Массы оценены по таблице 4: поршневая группа и колено — по диаметру цилиндра, шатун "
            "— по отношению S/D. Строка шатуна в доступном тексте учебника без чисел; приняты "
            "100…200 и 250…400 кг/м² (Колчин, Демидов). Замените оценку действительными массами."
        ),
    )


def _rod(model: InputFile) -> ScalarTable | None:
    """Centre of mass, found in the way that the input gives it."""
    given = model.masses
    if given.reciprocating_kg is not None:
        return None
    scalars: list[Scalar] = []
    if given.rod_weighed_small_end_kg is not None:
        text = "to_mm(L_rod*(1 - masses_rod_weighed_small_end_kg/masses_rod_kg))"
        scalars.append(Scalar("rod_l1", text, "Гоц (23)"))
    elif given.swing_edges_mm is not None:
        scalars += _swings()
    elif given.rod_centre_mm is not None:
        scalars.append(Scalar("rod_l1", "masses_rod_centre_mm", "Гоц, рис. 13"))
    else:
        share = "masses_rod_small_end_share"
        if given.rod_small_end_share is None:
            share = f"{ROD_SHARE}"
        scalars.append(Scalar("rod_l1", f"to_mm((1 - {share})*L_rod)", "Гоц (20)"))
    scalars.append(Scalar("rod_share", "1 - of_mm(rod_l1)/L_rod", "Гоц (20)"))
    return ScalarTable("rod_masses", "Центр масс шатуна", SHEET, tuple(scalars))


def _swings() -> list[Scalar]:
    def length(end: str) -> str:
        return f"9.81*(30/(pi*masses_swings_{end}_end_per_min))**2"

    edges, mass = "of_mm(masses_swing_edges_mm)", "masses_rod_kg"
    arm = f"{edges}*(k_C - {edges})/(k_A + k_C - 2*{edges})"
    return [
        *scalar_list(f"""
            T_small = 60/masses_swings_small_end_per_min | Гоц (24)
            T_big = 60/masses_swings_big_end_per_min | Гоц (24)
            k_A = {length("small")} | Гоц (25)
            k_C = {length("big")} | Гоц (25)
            swing_arm = to_mm({arm}) | Гоц (27)
            rod_l1 = swing_arm - masses_small_end_radius_mm | Гоц (27)
            rod_l2 = masses_swing_edges_mm - swing_arm | Гоц, рис. 16
            I_A = {mass}*k_A*of_mm(swing_arm) | Гоц (25)
            I_C = {mass}*k_C*of_mm(rod_l2) | Гоц (25)
        """),
    ]


def _three(model: InputFile) -> ScalarTable | None:
    """Two masses against three and the error in the moment of inertia."""
    given = model.masses
    if given.reciprocating_kg is not None:
        return None
    mass, l_1 = "masses_rod_kg", "of_mm(rod_l1)"
    ends = f"{mass}*(L_rod - {l_1})/L_rod*{l_1}**2 + {mass}*{l_1}/L_rod*(L_rod - {l_1})**2"
    scalars = [Scalar("I_two", ends, "Гоц (21)")]
    if given.rod_inertia_kg_m2 is not None or given.swing_edges_mm is not None:
        known = (
            f"I_A - {mass}*of_mm(swing_arm)**2"
            if given.swing_edges_mm is not None
            else "masses_rod_inertia_kg_m2"
        )
        scalars += [
            Scalar("I_sh", known, "Гоц (26)" if given.swing_edges_mm is not None else "задано"),
            *scalar_list(f"""
                dI_two = (I_two/I_sh - 1)*100 | Гоц, 2.2: I₁ > Iш
                m1_three = I_sh/({l_1}*L_rod) | Гоц, 2.2
                m2_three = I_sh/((L_rod - {l_1})*L_rod) | Гоц, 2.2
                m3_three = {mass} - I_sh/({l_1}*(L_rod - {l_1})) | из условий 2.2
                m3_share = m3_three/{mass}*100 | Гоц, 2.2
            """),
        ]
    return ScalarTable(
        "three_masses",
        "Замена шатуна двумя и тремя массами",
        SHEET,
        tuple(scalars),
        note=(
            "В учебнике у m3 пропущено слагаемое: из трёх условий следует "
            "m3 = mш − Iш/(l1(l − l1)). В динамическом расчёте шатун заменён двумя массами."
        ),
    )


def _webs(model: InputFile) -> ScalarTable | None:
    """Webs whose mass and radius are given, reduced to the crank radius."""
    scalars = [
        Scalar(
            f"web_red{number}",
            f"web_{number}_actual_mass_kg*of_mm(web_{number}_centre_mm)/r_crank",
            "Гоц (28)",
        )
        for number, web in enumerate(model.crankshaft.webs, 1)
        if web.actual_mass_kg is not None
    ]
    return ScalarTable("web_masses", "Приведение щёк к радиусу кривошипа", SHEET, tuple(scalars))


def _specific(model: InputFile) -> ScalarTable:
    """Masses over the piston area with the bounds of table 4."""
    given = model.masses
    kind = given.estimate_fuel or (model.cycle.kind if model.cycle is not None else None)

    def bounds(*tables: tuple[float, float]) -> tuple[float, float]:
        return min(low for low, _ in tables), max(high for _, high in tables)

    fuels = ("petrol", "diesel") if kind is None else (kind,)
    masses = [
        ("throw", "m_k", bounds(*(THROW[s, f] for s in ("steel", "iron") for f in fuels))),
    ]
    if given.reciprocating_kg is None:
        pistons = bounds(*(PISTON[m, f] for m in ("aluminium", "iron") for f in fuels))
        masses = [
            ("piston", "masses_piston_group_kg", pistons),
            ("rod", "masses_rod_kg", bounds(*(ROD[f] for f in fuels))),
            *masses,
        ]
    scalars = []
    for key, mass, (low, high) in masses:
        inside = f"area_{key} >= {low:g} and area_{key} <= {high:g}"
        shown = f"в пределах таблицы 4: {low:g}…{high:g} кг/м²"
        scalars += [
            Scalar(f"area_{key}", f"{mass}/F_piston", "Гоц, табл. 4"),
            Scalar(f"area_{key}_fits", f'"{YES}" if {inside} else "{NO}"', "Гоц, табл. 4",
                   note=shown, of="verdict"),
        ]  # fmt: skip
    if given.reciprocating_kg is None:
        inside = is_usual_share("rod_share")
        scalars.append(
            Scalar("rod_share_fits", f'"{YES}" if {inside} else "{NO}"', "Гоц, 2.2",
                   note=USUAL_SHARE, of="verdict")
        )  # fmt: skip
    return ScalarTable("specific_masses", "Удельные массы", SHEET, tuple(scalars))


def is_usual_share(name: str) -> str:
    """Expression that tells whether the share of that name is usual, its ends included."""
    low, high = SMALL_END_SHARE
    return f"round({name}, 6) >= {low:g} and round({name}, 6) <= {high:g}"
