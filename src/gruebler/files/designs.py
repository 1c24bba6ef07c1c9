"""Designs and results of the synthesis as plain data."""

from __future__ import annotations

from math import degrees, isnan
from typing import Any

from gruebler.design.synthesis.results import Design, SynthesisResult, pareto
from gruebler.files.linkages import linkage_to_json
from gruebler.files.tasks import task_to_json


def design_to_json(design: Design) -> dict[str, Any]:
    """Plain data: verdict, form, drive values in degrees (or the unit of length), linkage.

    The transmission angle over the whole range is only computed for accepted designs.
    """
    turning = bool(design.linkage.mechanism.drives) and design.linkage.mechanism.drives[0].turning
    verdict = design.verdict
    return {
        "accepted": verdict.accepted,
        "reasons": [str(reason) for reason in verdict.reasons],
        "form": design.form,
        "assembles": verdict.assembles,
        "one_circuit": verdict.one_circuit,
        "one_branch": verdict.one_branch,
        "in_order": verdict.in_order,
        "turns_fully": verdict.turns_fully,
        "transmission_through_targets": _or_none(degrees(verdict.transmission)),
        "transmission_over_range": _or_none(degrees(design.transmission_over_range)) if verdict.accepted else None,
        "links": design.links,
        "size": design.linkage.size,
        "size_ratio": _or_none(verdict.size_ratio),
        "inside": verdict.inside,
        "error": _or_none(verdict.error),
        "drives": [degrees(value) if turning else value for value in design.drives] or _drive_rows(design),
        **({} if design.optimum is None else {"minimax": design.optimum.to_json()}),
        "linkage": linkage_to_json(design.linkage),
    }


def _drive_rows(design: Design) -> list[list[float]]:
    drives = design.linkage.mechanism.drives
    return [
        [degrees(value) if drive.turning else value for value, drive in zip(row, drives, strict=True)]
        for row in design.drive_rows
    ]


def _or_none(value: float) -> float | None:
    return None if isnan(value) else value


def result_to_json(result: SynthesisResult) -> dict[str, Any]:
    """Plain data for `json.dumps`."""
    return {
        "task": task_to_json(result.task),
        "count": {
            "what": str(result.count.what),
            "theorem": result.count.theorem,
            "found": result.count.found,
            "infinite": result.count.infinite,
            "real": result.count.real,
        },
        "notes": [str(note) for note in result.notes],
        "designs": [design_to_json(each) for each in result.designs],
        "pareto": [
            {
                "design": next(k for k, design in enumerate(result.designs) if design is row.design),
                "error": row.error,
                "transmission_through_targets": _or_none(degrees(row.transmission)),
                "size": row.size,
                "links": row.links,
                "structure": row.structure,
            }
            for row in pareto(result)
        ],
        "rejected": [design_to_json(each) for each in result.rejected],
    }
