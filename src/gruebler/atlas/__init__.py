"""Every chain and mechanism with its properties, stored in Parquet files: built, opened and queried."""

from gruebler.atlas.building import build
from gruebler.atlas.parts import AtlasTask
from gruebler.atlas.reading import Atlas
from gruebler.atlas.reading import open_atlas as open
from gruebler.atlas.schema import SCHEMA, SchemaColumn, columns_of

__all__ = ["SCHEMA", "Atlas", "AtlasTask", "SchemaColumn", "build", "columns_of", "open"]
