"""Collection sheets: one mechanism on one page, with access features, exact dimensions, straight-line diagram."""

from gruebler.sheets.model import Sheet, Sized, Told
from gruebler.sheets.shelf import sheet, sheets

__all__ = ["Sheet", "Sized", "Told", "sheet", "sheets"]
