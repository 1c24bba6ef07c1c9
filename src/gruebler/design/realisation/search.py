"""The search: random drawings with small driven links, the best of them improved by small changes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gruebler.base.arrays import Reals
from gruebler.design.realisation.layout_program import LayoutProgram
from gruebler.design.realisation.layout_trial import LayoutTrial, try_layout

_KEPT = 4  # drawings to be improved
_ENOUGH = 12  # drawings that turn fully, after which no others are drawn
_DRAWING, _PATIENCE = 0.5, 80  # share of the budget for random drawings; changes without success before the end
_CLOSE = 1e-3  # the search ends at a score this near to the best possible


class SearchResult(NamedTuple):
    """The best drawing of a search."""

    drawing: Reals
    trial: LayoutTrial
    tries: int


def search_layouts(program: LayoutProgram, *, seed: int, budget: int, target_quality: float) -> SearchResult:
    """The best drawing of at most `budget` tried; same seed, same drawing."""
    rng = np.random.default_rng(seed)
    candidates: list[SearchResult] = []
    goal = (2 if all(d.turning for d in program.mechanism.drives) else 1) - _CLOSE
    tries = turning = 0
    while (
        tries < max(1, int(_DRAWING * budget))
        and turning < _ENOUGH
        and not (candidates and candidates[0].trial.score > goal)
    ):
        drawing = program.tied(_drawn(program, rng))
        trial = try_layout(program, drawing, target_quality)
        tries += 1
        turning += trial.full
        candidates = sorted(
            [*candidates, SearchResult(drawing, trial, tries)], key=lambda f: (-f.trial.score, f.tries)
        )[:_KEPT]
    for number, start in enumerate(candidates):
        share = (budget - tries) // (len(candidates) - number)
        candidates[number] = _improved(program, start, rng, share, target_quality, goal) if start.trial.score else start
        tries += candidates[number].tries if start.trial.score else 0
        if candidates[number].trial.score > goal:
            break
    best = max(candidates, key=lambda result: result.trial.score)
    return SearchResult(best.drawing, best.trial, tries)


def _improved(
    program: LayoutProgram,
    start: SearchResult,
    rng: np.random.Generator,
    budget: int,
    target_quality: float,
    goal: float,
) -> SearchResult:
    """Random changes, kept if they are better; their size adapts to their success."""
    drawing, best = start.drawing, start.trial
    step, idle, tries = 0.1, 0, 0
    while tries < budget and idle < _PATIENCE and best.score <= goal:
        changed = program.tied(_changed(program, drawing, rng, step))
        trial = try_layout(program, changed, target_quality)
        tries, idle = tries + 1, idle + 1
        step = max(0.005, step * 0.97)
        if trial.score > best.score:
            if trial.score > best.score + 1e-3:
                idle = 0
            drawing, best, step = changed, trial, min(0.2, step * 1.4)
    return SearchResult(drawing, best, tries)


def _drawn(program: LayoutProgram, rng: np.random.Generator) -> Reals:
    """Joints in the unit square away from each other; one link of each turning drive shrunk about its joint."""
    count = len(program.mechanism.chain.joints)
    drawing = np.empty((count, 3))
    drawing[:, 2] = rng.integers(0, 12, count) * np.pi / 12
    for k in range(count):
        trials = rng.uniform(0.0, 1.0, (6, 2))
        gaps = np.abs(trials[:, None, :] - drawing[None, :k, :2]).max(axis=2).min(axis=1, initial=1.0)
        drawing[k, :2] = trials[int(np.argmax(gaps))]
    for drive in program.mechanism.drives:
        if drive.turning:
            _shrink(program, drawing, drive.joint, _small_link(program, drive.between, rng), rng)
    return drawing


def _small_link(program: LayoutProgram, between: tuple[str, str], rng: np.random.Generator) -> str | None:
    """The moving link of a drive, sometimes the other; None: a random choice for each joint."""
    frame, chance = program.mechanism.frame, rng.uniform()
    links = sorted(between, key=lambda link: (link == frame, len(_joints(program, link))))
    straight = [link for link in links if not set(_joints(program, link)) & set(program.slides)]
    if not straight or chance < 0.3:
        return None
    return straight[0] if chance < 0.8 or len(straight) == 1 else straight[1]


def _joints(program: LayoutProgram, link: str) -> list[int]:
    return [k for k, joint in enumerate(program.mechanism.chain.joints) if link in joint.links]


def _shrink(program: LayoutProgram, drawing: Reals, pivot: int, link: str | None, rng: np.random.Generator) -> None:
    """Move the joints of a link, or each joint at random, nearer to a pivot."""
    centre = drawing[pivot, :2].copy()
    if link is None:
        factors = np.exp(rng.uniform(np.log(0.1), 0.0, len(drawing)))
        drawing[:, :2] = centre + factors[:, None] * (drawing[:, :2] - centre)
        return
    moved = _joints(program, link)
    factor = np.exp(rng.uniform(np.log(0.05), np.log(0.4)))
    drawing[moved, :2] = centre + factor * (drawing[moved, :2] - centre)


def _changed(program: LayoutProgram, drawing: Reals, rng: np.random.Generator, step: float) -> Reals:
    """A drawing with a change of one joint, of all joints, or of the size of one link."""
    changed, size = drawing.copy(), program.size(drawing)
    kind = rng.integers(0, 3)
    if kind == 0:
        k = int(rng.integers(0, len(changed)))
        changed[k, :2] += rng.normal(0.0, 2 * step * size, 2)
        changed[k, 2] += rng.normal(0.0, step)
    elif kind == 1:
        changed[:, :2] += rng.normal(0.0, step * size, (len(changed), 2))
        changed[:, 2] += rng.normal(0.0, step, len(changed))
    else:
        links = program.mechanism.chain.links
        resized = _joints(program, links[int(rng.integers(0, len(links)))])
        centre = changed[resized[int(rng.integers(0, len(resized)))], :2].copy()
        changed[resized, :2] = centre + np.exp(rng.normal(0.0, 5 * step)) * (changed[resized, :2] - centre)
    return changed
