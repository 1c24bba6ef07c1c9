"""An atlas opened: its tables for Arrow, pandas, polars and DuckDB, and its rows as chains and mechanisms."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gruebler.base.errors import GrueblerError, RunError, unknown
from gruebler.structure.atlas.building import manifest_of
from gruebler.structure.atlas.parts import AtlasTask
from gruebler.structure.atlas.schema import arrow_library
from gruebler.structure.chain import Chain
from gruebler.structure.isomorphism import decode
from gruebler.structure.mechanism.inversion import DrivenMechanism
from gruebler.structure.mechanism.model import Drive, Mechanism

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow as pa
    import pyarrow.dataset

MEMORY = "800 MB"
"""What DuckDB may take for a query."""
LARGEST_ANSWER = 400_000_000
"""Bytes of an answer."""
_ROWS = 100_000  # that are fetched at once
_CLOSED: dict[str, str | bool | int | float | list[str]] = {
    "memory_limit": MEMORY,
    "temp_directory": "",  # nothing is written to the disk
    "autoload_known_extensions": "false",
    "autoinstall_known_extensions": "false",
    "allow_community_extensions": "false",
    "python_enable_replacements": "false",  # the names of tables are not those of Python's variables
}

SMALL = Path(__file__).parent / "small"
"""The atlas that comes with the library: chains and mechanisms to 10 links, some driven."""


def open_atlas(directory: str | os.PathLike[str] | None = None) -> Atlas:
    """The atlas in a directory; without one, the small atlas that comes with the library.

    Nothing but the manifest is read before it is needed.

    Raises `RunError` for a directory that holds no complete atlas, or one of a newer version.
    """
    return Atlas(SMALL if directory is None else Path(directory))


class Atlas:
    """An atlas in a directory.

    >>> atlas = open_atlas()
    >>> atlas.query("select count(*) as chains from chains where links = 10 and mobility = 1").to_pylist()
    [{'chains': 230}]
    """

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self.manifest = manifest_of(directory)
        if not self.manifest.get("complete"):
            raise RunError(
                "the atlas in {directory} is not complete; `{command}` continues it",
                directory=directory,
                command=self.manifest.get("command"),
            )

    @property
    def tables(self) -> tuple[str, ...]:
        """The names of its tables."""
        return tuple(self.manifest["tables"])

    def files(self, table: str = "chains") -> list[Path]:
        """The files of a table, in canonical order.

        Raises:
            GrueblerError: there is no such table.
            RunError: a file is missing.
        """
        if table not in self.tables:
            raise GrueblerError(
                "the atlas in {directory} has no table {word!r}{suggestion}",
                directory=self.directory,
                **unknown(table, self.tables),
            )
        files = [self.directory / file["path"] for file in self.manifest["tables"][table]["files"]]
        missing = next((file for file in files if not file.is_file()), None)
        if missing is not None:
            raise RunError("{path} is missing; build the atlas again to restore it", path=missing)
        return files

    def dataset(self, table: str = "chains") -> pyarrow.dataset.Dataset:
        """A table for Arrow, read lazily."""
        arrow_library()
        import pyarrow.dataset

        return pyarrow.dataset.dataset(self.files(table), format="parquet")  # type: ignore[no-untyped-call,unused-ignore]

    def polars(self, table: str = "chains") -> polars.LazyFrame:
        """A table for polars, read lazily; `GrueblerError` if polars is not installed."""
        try:
            import polars
        except ImportError:
            raise GrueblerError("this needs polars: pip install polars") from None
        return polars.scan_parquet(self.files(table))

    def query(self, sql: str) -> pa.Table:
        """The answer to a query in SQL, in the dialect of DuckDB; its tables are those of the atlas.

        A query reads the files of the atlas and nothing else: no other file, no network, no extension, no variable of
        the program. DuckDB may take `MEMORY`, the answer `LARGEST_ANSWER`.

        Raises `GrueblerError` with the reason for a query that cannot be answered, whose answer is too large, and if
        DuckDB is not installed.

        >>> open_atlas().query("select code from chains where links = 4 and mobility = 1")["code"].to_pylist()
        ['gr1:R(0-1)R(0-2)R(1-3)R(2-3)']
        """
        connection = self._connection
        import duckdb

        try:
            statements = connection.extract_statements(sql)
            if len(statements) != 1 or statements[0].type != duckdb.StatementType.SELECT:
                raise GrueblerError("a query is one statement that begins with select, with or from")
            relation = connection.sql(statements[0])
            # DuckDB 1 has the second only; a table, or the relation as a stream, would be whole in memory at once.
            reader = getattr(relation, "to_arrow_reader", None) or relation.fetch_record_batch
            rows = reader(_ROWS)
            batches, size = [], 0
            for batch in rows:
                size += batch.nbytes
                if size > LARGEST_ANSWER:
                    raise GrueblerError(
                        "the answer is larger than {most} MB; ask for fewer rows or columns",
                        most=LARGEST_ANSWER // 10**6,
                    )
                batches.append(batch)
            return arrow_library().Table.from_batches(batches, rows.schema)
        except duckdb.OutOfMemoryException:
            raise GrueblerError("the query needs more than {memory} of memory", memory=MEMORY) from None
        except duckdb.Error as error:
            raise GrueblerError("the query cannot be answered: {reason}", reason=_reason(str(error))) from None

    def pandas(self, sql: str) -> pandas.DataFrame:
        """The answer to a query for pandas; `GrueblerError` if pandas is not installed."""
        try:
            import pandas  # noqa: F401  what follows needs it
        except ImportError:
            raise GrueblerError("this needs pandas: pip install pandas") from None
        return self.query(sql).to_pandas()

    def structures(self, sql: str) -> Iterator[Chain | DrivenMechanism]:
        """The rows of a query as values: chains, or mechanisms if it selects a frame, with drives if it selects them.

        Args:
            sql: selects ``code`` or ``chain``, perhaps ``frame`` and ``drives``; other columns are not used.

        Raises `GrueblerError` for a query that selects neither a code nor a chain, and as `query` does.

        >>> rows = open_atlas().structures("select chain, frame, drives from driven where links = 4 and mobility = 1")
        >>> [str(each) for each in rows]
        ['R(0-1) R(0-2) R(1-3) R(2-3); frame=0; drive=R(0-1)']
        """
        table = self.query(sql)
        names = table.column_names
        code = next((name for name in ("chain", "code") if name in names), None)
        if code is None:
            raise GrueblerError(
                "to give chains or mechanisms, a query selects code, or chain, perhaps frame and drives"
            )
        for batch in table.to_batches():
            for row in batch.to_pylist():
                chain = decode(row[code]).chain
                if "frame" not in names:
                    yield chain
                else:
                    drives = _drives(chain, row["drives"]) if "drives" in names else ()
                    yield DrivenMechanism(Mechanism(chain, str(row["frame"]), drives))

    def covers(self, links: int, mobility: int, prismatic: int = 0, multiple_joints: int = 0) -> bool:
        """Whether it has all chains of these numbers, fractionated ones included.

        >>> open_atlas().covers(10, 1), open_atlas().covers(10, 1, prismatic=1)
        (True, False)
        """
        tasks = map(AtlasTask.of_command, str(self.manifest.get("command")).split("; "))
        return any(task.covers(links, mobility, prismatic, multiple_joints) for task in tasks)

    def chains(self, where: str = "true") -> Iterator[Chain]:
        """The chains that satisfy a condition in SQL, in the order of the atlas.

        >>> next(open_atlas().chains("links = 6 and mobility = 1")).n
        6
        """
        for chain in self.structures(f"select code from chains where {where}"):
            assert isinstance(chain, Chain)
            yield chain

    def mechanisms(self, where: str = "true") -> Iterator[Mechanism]:
        """The mechanisms that satisfy a condition in SQL, in the order of the atlas."""
        for each in self.structures(f"select chain, frame from mechanisms where {where}"):
            assert isinstance(each, DrivenMechanism)
            yield each.mechanism

    def driven_mechanisms(self, where: str = "true") -> Iterator[DrivenMechanism]:
        """The driven mechanisms that satisfy a condition in SQL, in the order of the atlas.

        >>> [str(each) for each in open_atlas().driven_mechanisms("links = 4 and mobility = 1")]
        ['R(0-1) R(0-2) R(1-3) R(2-3); frame=0; drive=R(0-1)']
        """
        for each in self.structures(f"select chain, frame, drives from driven where {where}"):
            assert isinstance(each, DrivenMechanism)
            yield each

    @cached_property
    def _connection(self) -> Any:
        """DuckDB with a view for every table; it reads nothing yet."""
        try:
            import duckdb
        except ImportError:
            raise GrueblerError("queries need duckdb: pip install 'gruebler[atlas]'") from None
        arrow_library()
        connection = duckdb.connect(":memory:", config=_CLOSED)
        for table in self.tables:
            files = ", ".join(_quoted(path.resolve()) for path in self.files(table))
            try:
                connection.execute(
                    f"create view {table} as select * from read_parquet([{files}], hive_partitioning = false)"
                )
            except duckdb.Error as error:
                raise RunError(
                    "the atlas in {directory} cannot be read: {reason}; build it again to restore it",
                    directory=self.directory,
                    reason=_reason(str(error)),
                ) from None
        # Queries may come from elsewhere: from here on no other file is read, and no setting can be changed.
        connection.execute(f"set allowed_directories = [{_quoted(self.directory.resolve())}]")
        connection.execute("set enable_external_access = false")
        connection.execute("set lock_configuration = true")
        return connection


def _quoted(path: Path) -> str:
    """A path as a text in SQL."""
    return "'" + str(path).replace("'", "''") + "'"


def _drives(chain: Chain, text: str) -> Iterator[Drive]:
    """The drives of a row: each the two links that it moves against each other."""
    for pair in text.split():
        ends = set(pair.split("-"))
        number, joint = next((k, joint) for k, joint in enumerate(chain.joints) if ends <= set(joint.links))
        first, other = sorted(ends, key=joint.links.index)
        yield Drive(number, joint.pair.freedoms[chain.space][0], (first, other))


def _reason(text: str) -> str:
    """The first sentences of a message of DuckDB, without the picture of the query."""
    lines = [line.strip() for line in text.splitlines()]
    kept = []
    for line in lines:
        if line.startswith("LINE "):
            break
        if line:
            kept.append(line)
    return " ".join(kept)
