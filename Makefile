# Two commands do everything, the environment included: `make demo` and `make test`.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready

.PHONY: help demo test fast slow wheel-test bench clean

help:
	@echo "make demo        every machine and exercise of the catalog checked, four of them explained"
	@echo "make test        ruff, mypy --strict, all fast tests and doctests"
	@echo "make slow        the long tests"
	@echo "make wheel-test  the fast tests against the built wheel, in an environment of its own"
	@echo "make bench       the benchmarks of benchmarks/README.md"

# Reinstalled only when pyproject.toml changes: repeated calls start at once.
$(READY): pyproject.toml
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[test]"
	@touch $@

demo: $(READY)
	@$(BIN)/gruebler demo

test: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python -m pytest -q -n 2

slow: $(READY)
	$(BIN)/python -m pytest -q -m slow

wheel-test: $(READY)
	rm -rf build/wheel
	$(BIN)/python -m build --wheel --outdir build/wheel . >/dev/null
	$(PYTHON) -m venv build/wheel/venv
	build/wheel/venv/bin/python -m pip install --quiet --disable-pip-version-check \
		"$$(ls build/wheel/*.whl)[test]"
	cd build/wheel && venv/bin/python -m pytest -q -n 2 -c ../../pyproject.toml --rootdir ../.. -o cache_dir=.cache \
		$(addprefix ../../tests/,cli catalog exercises sheets test_chain.py test_pairs.py)

bench: $(READY)
	$(BIN)/python -m benchmarks

clean:
	rm -rf $(VENV) build dist
