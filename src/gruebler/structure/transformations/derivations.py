"""Derivations: a chain and the recorded steps from it, which can be replayed."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from gruebler.base.errors import NotationError, TransformationError
from gruebler.base.notebook import explained
from gruebler.base.text import translate
from gruebler.structure.chain import Chain
from gruebler.structure.chain.pairs import Alphabet
from gruebler.structure.transformations.contacts import replace_roll_slide, restore_roll_slide
from gruebler.structure.transformations.contraction import contract, expand
from gruebler.structure.transformations.dyads import insert_coupler, insert_dyad, remove_coupler, remove_dyad
from gruebler.structure.transformations.groups import insert_group, remove_group
from gruebler.structure.transformations.steps import Step

OPERATIONS: dict[str, Callable[..., Step]] = {
    operation.__name__: operation
    for operation in (
        insert_dyad,
        remove_dyad,
        insert_coupler,
        remove_coupler,
        insert_group,
        remove_group,
        contract,
        expand,
        replace_roll_slide,
        restore_roll_slide,
    )
}
"""Every transformation by the name under which steps record it."""


def replay(chain: Chain, kind: str, where: Mapping[str, Any]) -> Step:
    """Apply a recorded step to a chain.

    Raises `TransformationError` for an unknown kind, for arguments that the kind does not have, and where the step is
    not possible.

    >>> step = insert_dyad(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-0)"), "RRR", ["0", "2"])
    >>> replay(step.before, step.kind, step.where) == step
    True
    """
    if kind not in OPERATIONS:
        raise TransformationError(
            "there is no transformation {kind!r}; there are {operations}", kind=kind, operations=", ".join(OPERATIONS)
        )
    try:
        return OPERATIONS[kind](chain, **where)
    except TypeError as error:
        raise TransformationError("{kind}: the record does not fit: {error}", kind=kind, error=error) from None


@explained
@dataclass(frozen=True)
class Derivation:
    """A start chain and steps, each from the chain that results from the previous one.

    >>> steps = Derivation(Chain.parse("R(0-1) R(1-2) R(2-3) R(3-4) R(4-0)"))
    >>> steps = steps.then("insert_coupler", between=["1", "4"]).then("insert_dyad", form="RRR", between=["2", "5"])
    >>> steps.chain.n, Derivation.from_json(steps.to_json()) == steps
    (8, True)
    """

    start: Chain
    steps: tuple[Step, ...] = ()

    def __post_init__(self) -> None:
        before = self.start
        for number, step in enumerate(self.steps, 1):
            if step.before != before:
                raise TransformationError(
                    "step {number} starts from {chain}, but step {previous} leaves {result}",
                    number=number,
                    chain=step.before,
                    previous=number - 1,
                    result=before,
                )
            before = step.chain

    @property
    def chain(self) -> Chain:
        """The chain at the end."""
        return self.steps[-1].chain if self.steps else self.start

    def then(self, kind: str, **where: Any) -> Derivation:
        """With one more step."""
        return Derivation(self.start, (*self.steps, replay(self.chain, kind, where)))

    def replayed(self, start: Chain | None = None) -> Derivation:
        """All steps replayed, from the same chain or from another one with the links and joints that they name."""
        derivation = Derivation(self.start if start is None else start)
        for step in self.steps:
            derivation = derivation.then(step.kind, **step.where)
        return derivation

    def to_json(self) -> dict[str, Any]:
        """Plain data for `json.dumps`: the start chain, and kind, where and result of each step."""
        return {"start": self.start.to_json(), "steps": [step.to_json() for step in self.steps]}

    @classmethod
    def from_json(cls, document: str | Mapping[str, Any]) -> Derivation:
        """The derivation of a document made by `to_json` (the text, or the object read); every step is replayed.

        Raises `NotationError` for another document, `TransformationError` for a step that is impossible or leads to
        another chain than the document states.
        """
        if isinstance(document, str):
            try:
                document = json.loads(document)
            except json.JSONDecodeError as error:
                raise NotationError("not a JSON document: {error}", error=error) from None
        match document:
            case {"start": start, "steps": [*steps], **rest} if not rest:
                derivation = cls(Chain.from_json(start))
            case _:
                raise NotationError('a derivation is an object with "start" (a chain) and "steps" (a list)')
        for number, step in enumerate(steps, 1):
            match step:
                case {"kind": str(kind), "where": Mapping() as where, **rest} if rest.keys() <= {"result"}:
                    derivation = derivation.then(kind, **where)
                case _:
                    raise NotationError(
                        'step {number} must be an object with "kind", "where" and perhaps "result"', number=number
                    )
            if "result" in step and str(derivation.chain) != step["result"]:
                raise TransformationError(
                    "step {number} gives {chain}, but the document says {step}",
                    number=number,
                    chain=derivation.chain,
                    step=step["result"],
                )
        return derivation

    def explain(self, lang: str = "en") -> str:
        """A line for the start and for each step, in English (``en``) or German (``de``)."""
        alphabet = Alphabet.of_language(lang)
        lines = [translate("Start: {chain}.", lang, chain=self.start.text(alphabet))]
        lines += [f"{number}. {step.explain(lang)}" for number, step in enumerate(self.steps, 1)]
        if self.steps:
            lines.append(translate("The chain: {chain}.", lang, chain=self.chain.text(alphabet)))
        return "\n".join(lines)
