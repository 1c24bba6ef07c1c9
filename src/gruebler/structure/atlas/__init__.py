"""Every chain and mechanism with its properties, stored in Parquet files: built, opened and queried."""

from gruebler.structure.atlas.building import build
from gruebler.structure.atlas.parts import AtlasTask
from gruebler.structure.atlas.reading import Atlas
from gruebler.structure.atlas.reading import open_atlas as open
from gruebler.structure.atlas.schema import SCHEMA, SchemaColumn, columns_of

__all__ = ["SCHEMA", "Atlas", "AtlasTask", "SchemaColumn", "build", "columns_of", "open"]
