"""Printable documents for teaching: task sheets with solutions, one page for any machine, the book of the catalog.

`blocks` is a document as a value; `files` writes it as PDF, HTML, LaTeX or Markdown.
"""

from gruebler.teaching.worksheets.blocks import Document
from gruebler.teaching.worksheets.files import DOCUMENT_SUFFIXES, document_bytes
from gruebler.teaching.worksheets.machines import catalog_book, machine_document
from gruebler.teaching.worksheets.posters import POSTERS, poster
from gruebler.teaching.worksheets.tasks import TaskSheet, solution_document, worksheet

__all__ = [
    "DOCUMENT_SUFFIXES",
    "POSTERS",
    "Document",
    "TaskSheet",
    "catalog_book",
    "document_bytes",
    "machine_document",
    "poster",
    "solution_document",
    "worksheet",
]
