"""Settings of the site. `make docs` builds it in English and German into build/docs/html."""

import os
import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))
os.environ["COLUMNS"] = "88"  # the width of what commands print

import gruebler  # noqa: E402  after the path is set

project = "gruebler"
author = "The gruebler maintainers"
copyright = "2026, The gruebler maintainers"
version = release = gruebler.__version__

extensions = ["myst_parser", "sphinx_copybutton", "builder"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_pictures", "notebooks", "README.md"]
nitpicky = True
nitpick_ignore_regex = [("py:class", ".*")]  # types in signatures: many are of numpy or private
smartquotes = False

myst_enable_extensions = ["colon_fence", "deflist", "attrs_inline", "dollarmath"]
myst_heading_anchors = 4
myst_links_external_new_tab = True

locale_dirs = ["locale"]
gettext_compact = False
gettext_uuid = False
gettext_location = False
gettext_additional_targets: list[str] = []

html_theme = "furo"
html_title = f"gruebler {version}"
html_static_path = ["_static"]
templates_path = ["_templates"]
html_favicon = "_static/favicon.svg"
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False
html_math_renderer = "mathml"
python_maximum_signature_line_length = 90
toc_object_entries_show_parents = "hide"
copybutton_prompt_text = r"\$ |>>> |\.\.\. "
copybutton_prompt_is_regexp = True
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/search.html",
        "languages.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b5c8a", "color-brand-content": "#0b5c8a"},
    "dark_css_variables": {"color-brand-primary": "#7cc4ee", "color-brand-content": "#7cc4ee"},
    "navigation_with_keys": True,
}
pygments_style = "friendly"
pygments_dark_style = "monokai"
