"""Collection sheets: one mechanism on one page, with access features, exact dimensions, straight-line diagram."""

from gruebler.teaching.sheets.loader import all_sheets, sheet
from gruebler.teaching.sheets.model import Sheet, SizedMechanism, StatedValue

__all__ = ["Sheet", "SizedMechanism", "StatedValue", "all_sheets", "sheet"]
