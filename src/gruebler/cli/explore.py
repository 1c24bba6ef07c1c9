"""`gruebler explore`: a page on which a mechanism moves and can be dragged, from a server here or as one file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from gruebler.base.errors import GrueblerError
from gruebler.base.text import LANGUAGES, translate
from gruebler.cli.draw import entry_of, linkage_and_range
from gruebler.cli.linkage_inputs import SpatialWord, spatial_of_word
from gruebler.cli.long_work import progress
from gruebler.cli.output import write_file
from gruebler.cli.parser import Parser
from gruebler.page.exchange import document_of
from gruebler.page.model import model_of, with_document

_PORT = 8117
_FIRST = "lambda"
"""What is shown unless something is named: a four-bar whose point goes straight and back in a bow."""


def add(parser: Parser) -> None:
    """Add the arguments."""
    parser.describe(
        description="A page on which a linkage moves, its joints and lengths are dragged, and curve, dead centres and "
        "transmission angle follow at once; it also lists chains, inversions and joint types, finds dimensions, shows "
        "the catalog and sets exercises. With -o one HTML file that moves and can be dragged without any server.",
        epilog="Examples: gruebler explore; gruebler explore four-bar:25,70,40,70; gruebler explore lambda -o "
        "lambda.html. The server needs starlette and uvicorn: pip install 'gruebler[web]'.",
    )
    parser.take(
        """
        linkage FILE|ID|CHAIN|LENGTHS|ADDRESS ?  a file, a catalog entry, a chain or mechanism as text,
            lengths such as four-bar:25,70,40,70, or an address copied from the page (default: lambda, which moves)
        """
    )
    parser.add_out(help="one file .html instead of a server", endings=("html", "htm"))
    parser.take(
        """
        --site DIR path  a static site instead of a server: the page with catalog, exercises and all chains to ten
            links, for any server of files; about two minutes
        --jobs
        --port N int  the port (default: 8117, or any free one)
        --host ADDRESS =127.0.0.1  the address that the server listens on (default: 127.0.0.1)
        --no-browser  only print the address
        """
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the file, or serve until interrupted."""
    if arguments.port is not None and not 0 <= arguments.port < 65536:
        raise GrueblerError("--port: expected a number from 0 to 65535, but found {port}", port=arguments.port)
    word = arguments.linkage or _FIRST
    if (spatial := spatial_of_word(word, arguments.lang)) is not None:
        return _in_space(spatial, arguments)
    model = _model(word, arguments.lang) | {"plays": arguments.linkage is None}
    if arguments.out is not None:
        from gruebler.page.page import single_file

        write_file(arguments.out, single_file(model, _page_language(arguments.lang)).encode("utf-8"), arguments.lang)
        return 0
    return _serve(model, arguments) if arguments.site is None else _write_site(model, arguments)


def _in_space(spatial: SpatialWord, arguments: argparse.Namespace) -> int:
    """The page of a linkage in space, as a file or beside the others of the server."""
    from gruebler.page.space_page import machine_model, space_file, space_model

    word = arguments.linkage
    if arguments.site is not None:
        raise GrueblerError("a site opens with a linkage in the plane; it has the machines in space beside it")
    record, home = entry_of(word), arguments.out is None
    if record is None:
        titles = dict.fromkeys(LANGUAGES, _name(word))
        model = space_model(spatial.linkage, titles=titles, between=spatial.range, home=home, asks=home)
    else:
        model = machine_model(word, home=home, asks=home)
    page = space_file(model, arguments.lang)
    if arguments.out is None:
        return _serve(_model(_FIRST, arguments.lang), arguments, in_space=page)
    write_file(arguments.out, page.encode("utf-8"), arguments.lang)
    return 0


def _write_site(model: dict[str, Any], arguments: argparse.Namespace) -> int:
    from gruebler.page.static_site import write_site
    from gruebler.structure.enumeration.worker_pool import ProcessPools

    words = translate("parts: {n} of {total}", arguments.lang)
    size = write_site(
        arguments.site,
        model,
        lang=_page_language(arguments.lang),
        executor=None if arguments.jobs == 1 else ProcessPools(arguments.jobs),
        progress=lambda items, total: progress(items, words.replace("{total}", str(total))),
    )
    print(
        translate(
            "The site is in {folder}: {size:.1f} MB. Give the folder to any server of files, or open index.html.",
            arguments.lang,
            folder=arguments.site,
            size=size / 1e6,
        )
    )
    return 0


def _model(word: str, lang: str) -> dict[str, Any]:
    """The model of a word; a chain gets dimensions."""
    if "#" in word or word.startswith("1."):
        from gruebler.files import linkage_from_json
        from gruebler.page.links import read_link

        shared = read_link(word)
        linkage = linkage_from_json(shared.document)
        return with_document(model_of(linkage, name=shared.name, source=shared.source), linkage, shared.document)
    if "(" in word and not Path(word).is_file():
        from gruebler.design.realisation.realising import realise
        from gruebler.page.structures import mechanism_of_text

        realisation = realise(mechanism_of_text(word))
        if realisation.linkage is None:
            raise GrueblerError("{message}", message=realisation.explain(lang))
        return model_of(realisation.linkage)
    linkage, between = linkage_and_range(word, unit="mm")  # which the page writes into files
    record = entry_of(word)
    name, stops = (_name(word), ()) if record is None else (record.name, record.stops)
    model = model_of(linkage, name=name, source=word, between=between, stops=stops)
    return with_document(model, linkage, document_of(Path(word), linkage)) if Path(word).is_file() else model


def _name(word: str) -> str:
    """What a page is called that shows a word: the name of a file without its folder and ending."""
    return Path(word).stem if Path(word).is_file() else word


def _serve(model: dict[str, Any], arguments: argparse.Namespace, *, in_space: str = "") -> int:
    try:
        from gruebler.page import server
    except ImportError:
        raise GrueblerError(
            "the server of the page needs starlette and uvicorn: pip install 'gruebler[web]', or write one file with -o"
        ) from None
    listening = server.bound_socket(
        arguments.host, _PORT if arguments.port is None else arguments.port, arguments.port is not None
    )
    host, port = listening.getsockname()[:2]
    shown = f"[{host}]" if ":" in host else host
    token = server.kept_token()
    address = f"http://{shown}:{port}/{token}/" + (f"space/{server.OPENED}.html" if in_space else "")
    print(translate("The page is at {address}", arguments.lang, address=address))
    print(translate("Stop it with Ctrl+C.", arguments.lang), flush=True)
    if not arguments.no_browser and sys.stdout.isatty():
        import webbrowser

        webbrowser.open(address)
    lang = _page_language(arguments.lang)
    names = frozenset() if host in ("127.0.0.1", "::1") else frozenset({arguments.host, shown})
    server.run_server(server.ExplorerServer(model, token, lang=lang, names=names, in_space=in_space), listening)
    return 0


def _page_language(lang: str) -> str:
    """The language in which the page opens: another than English if it is asked for, else the browser's own."""
    return "" if lang == LANGUAGES[0] else lang
