"""Designs and results of the synthesis as plain data."""

from __future__ import annotations

from math import degrees
from typing import Any

from gruebler.base.plain_data import plain
from gruebler.design.synthesis.results import Design, SynthesisResult, pareto
from gruebler.design.synthesis.sensitivity import Sensitivity
from gruebler.files.linkages import linkage_to_json
from gruebler.files.tasks import task_to_json

_ANGLES = dict.fromkeys(("transmission", "transmission_over_range"), degrees)


def design_to_json(design: Design) -> dict[str, Any]:
    """Plain data: verdict, form, drive values in degrees (or the unit of length), linkage.

    The transmission angle over the whole range and the sensitivity are only computed for accepted designs.
    """
    drives, verdict = design.linkage.mechanism.drives, design.verdict
    turning = bool(drives) and drives[0].turning
    keys = "accepted reasons assembles one_circuit one_branch in_order turns_fully size_ratio inside pivot_distance"
    errors = "error over_interval between"
    sensitivity = design.sensitivity if verdict.accepted else None
    over_range = plain(design, "transmission_over_range", units=_ANGLES) if verdict.accepted else {}
    return {
        **plain(verdict, f"{keys} {errors}"),
        "transmission_through_targets": plain(verdict, "transmission", units=_ANGLES)["transmission"],
        "transmission_over_range": over_range.get("transmission_over_range"),
        **plain(design, "form links"),
        "size": design.linkage.size,
        "drives": [degrees(value) if turning else value for value in design.drives]
        or [
            [degrees(value) if drive.turning else value for value, drive in zip(row, drives, strict=True)]
            for row in design.drive_rows
        ],
        **({} if design.optimum is None else {"minimax": design.optimum.to_json()}),
        **({} if sensitivity is None else {"sensitivity": _sensitivity_to_json(design, sensitivity)}),
        "linkage": linkage_to_json(design.linkage),
    }


def _sensitivity_to_json(design: Design, sensitivity: Sensitivity) -> dict[str, Any]:
    """For each target and quantity how far it moves per 0.1 % of each length; directions as arcs, by their length."""
    return {
        "relative": design.relative_sensitivity,
        "worst": sensitivity.worst.tolist(),
        "statistical": sensitivity.statistical.tolist(),
        "lengths": [
            {**plain(row, "link first other across length"), "moves": abs(sensitivity.moves[:, :, k]).tolist()}
            for k, row in enumerate(sensitivity.lengths)
        ],
    }


def result_to_json(result: SynthesisResult) -> dict[str, Any]:
    """Plain data for `json.dumps`."""
    rows = []
    for row in pareto(result):
        shown = plain(row, "error transmission size links structure", units=_ANGLES)
        number = next(k for k, design in enumerate(result.designs) if design is row.design)
        rows.append({"design": number, "transmission_through_targets": shown.pop("transmission"), **shown})
    return {
        "task": task_to_json(result.task),
        "count": plain(result.count, "what theorem found infinite real"),
        "notes": [str(note) for note in result.remarks],
        "designs": [design_to_json(each) for each in result.designs],
        "pareto": rows,
        "rejected": [design_to_json(each) for each in result.rejected],
    }
