"""The page comes in pieces."""


def test_the_page_starts_in_pieces(tab, server):
    """What changes in one piece of work is told to an observer at once, after it."""
    page = tab()
    page.page.add_init_script(
        """window.seen = [];
        new MutationObserver(() => {
            const shadow = document.querySelector('.gruebler-explorer')?.shadowRoot;
            if (!shadow || shadow.seen) return;
            shadow.seen = true;
            const count = (names) => shadow.querySelectorAll(names).length;
            new MutationObserver(() => seen.push(
                [count('.stage .joint'), count('.facts dd'), count('.plot .curve[d]')].map((n) => n > 0).join(),
            )).observe(shadow, { childList: true, subtree: true, attributes: true });
        }).observe(document, { childList: true, subtree: true });"""
    )
    page.open(server.address)
    seen = page.page.evaluate("[...new Set(seen)]")
    for part in ("true,false,false", "true,true,false", "true,true,true"):  # picture, measures, plots
        assert part in seen
