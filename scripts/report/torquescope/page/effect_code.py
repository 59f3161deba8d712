"""The torque of effects as expressions in C: {name: (its parameters, expression)}; words as in
engine/effects/instant_code.hpp. Written by scripts/document_effects: do not edit by hand."""

CODE = {
    "inertia": (
        ("inertia",),
        "inertia * ddq"),
    "viscous": (
        ("viscous",),
        "viscous * dq"),
    "coulomb_positive": (
        ("coulomb_positive",),
        "coulomb_positive * (dq > 0)"),
    "coulomb_negative": (
        ("coulomb_negative",),
        "coulomb_negative * (dq < 0)"),
    "coulomb": (
        ("coulomb",),
        "coulomb * s"),
    "offset": (
        ("offset",),
        "offset"),
    "gravity": (
        ("gravity_sin", "gravity_cos"),
        "gravity_sin * sin(q) + gravity_cos * cos(q)"),
    "asymmetric_viscous": (
        ("asymmetric_viscous",),
        "asymmetric_viscous * fabs(dq)"),
    "stribeck": (
        ("stribeck", "stribeck_speed", "stribeck_exponent"),
        "friction_sign * stribeck * exp(-pow(fabs(dq) / stribeck_speed, stribeck_exponent))"),
    "speed_drag": (
        ("quadratic_drag", "cubic_drag"),
        "quadratic_drag * dq * fabs(dq) + cubic_drag * dq * dq * dq"),
    "power_law_viscous": (
        ("power_law_viscous", "power_law_exponent"),
        "s * power_law_viscous * pow(fabs(dq), power_law_exponent)"),
    "position_dependent_friction": (
        ("position_friction_slope", "position_friction_cos", "position_friction_sin", "position_friction_order"),
        "friction_sign * (position_friction_slope * q + position_friction_cos * cos(position_friction_order *"
        " q) + position_friction_sin * sin(position_friction_order * q))"),
    "load_dependent_friction": (
        ("load_dependent_friction", "load_friction_inertia_share", "load_friction_preload"),
        "friction_sign * load_dependent_friction * (sqrt(pow(load - (1 - load_friction_inertia_share) * "
        "baseline_inertia * ddq, 2) + pow(load_friction_preload, 2)) - load_friction_preload)"),
    "spring": (
        ("spring", "spring_hardening", "spring_rest"),
        "spring * (q + spring_hardening * pow(q - spring_rest, 3))"),
    "cogging": (
        ("cogging_cos", "cogging_sin", "cogging_order"),
        "cogging_cos * cos(cogging_order * q) + cogging_sin * sin(cogging_order * q)"),
}
