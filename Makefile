# Two commands do everything, the environment included: `make demo` and `make test`.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
INSTALLED := $(VENV)/.installed

# Each worker begins with one part, so that few files are split between them and what they share is made once; three on two
# cores, since tests in a browser wait for a quarter of their time.
TESTED := -m pytest -q -n 3 --dist worksteal

.PHONY: help demo test lint fast docs handbook messages slow wheel-test test-blas lowest-packages test-lowest test-newest \
	page core test-core core-sanitize core-sanitize-python torture mutants bench evidence paper clean

help:
	@echo "make demo        every machine and exercise of the catalog checked, four of them explained"
	@echo "make test        ruff, mypy --strict, all fast tests and doctests"
	@echo "make docs        the site in English and German in build/docs/html, with the page; about four minutes"
	@echo "make handbook    the site as two PDF files in build/docs, printed by chromium; two minutes more"
	@echo "make messages    brings the German catalog up to date with the code and lists what is untranslated"
	@echo "make slow        the long tests, and the fast ones with new random examples"
	@echo "make torture     5,000 damaged inputs, 200 interrupts, 300 kills, see docs/reliability.md; about an hour"
	@echo "make mutants     one line of a room changed at a time: do its tests notice? ROOM=mobility NUMBER=20"
	@echo "make wheel-test  the fast tests against the built wheel, in an environment of its own"
	@echo "make test-blas   the numerical tests with kernels of OpenBLAS that this processor does not choose"
	@echo "make test-lowest a broad choice of tests with the lowest versions that pyproject.toml allows"
	@echo "make test-newest a broad choice of tests with another Python (NEWEST=python3.13) and the newest versions"
	@echo "make core        the C++ kernels alone, compiled where they changed, see core/README.md"
	@echo "make test-core   the tests of the C++ kernels, against plain Python and against print"
	@echo "make core-sanitize  the C++ kernels with address and undefined-behaviour sanitizers, without Python"
	@echo "make core-sanitize-python  the tests that call the C++ kernels most, with the same sanitizers; needs GCC"
	@echo "make page        the modules of the page from the kernels, and the built page; needs node"
	@echo "make bench       the benchmarks of benchmarks/README.md"
	@echo "make evidence    the numbers of docs/tables derived again, contracted graphs by a second method"
	@echo "make paper       the paper of paper/manuscript.md with its numbers and figures in build/paper"

# Reinstalled only when pyproject.toml or the C++ sources change: repeated calls start at once. What did not change is not
# compiled again.
SOURCES := pyproject.toml core/CMakeLists.txt $(shell find core/src core/python core/build_backend -name '*.?pp' -o -name '*.py')
$(READY): $(SOURCES)
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[test]"
	@touch $@ $(INSTALLED)

# Without what only the tests need.
$(INSTALLED): $(SOURCES)
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -e .
	@touch $@

# The same for what builds the site.
$(VENV)/.docs: pyproject.toml
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[docs]"
	@touch $@

demo: $(INSTALLED)
	@$(BIN)/gruebler demo

test: lint fast

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

fast: $(READY)
	$(BIN)/python $(TESTED)

# Any warning stops it. English lies at the root, German in the folder de.
SPHINX := -m sphinx -q -W --keep-going -b html
docs: $(VENV)/.docs
	rm -rf build/docs docs/_pictures docs/reference/api
	$(BIN)/python $(SPHINX) -d build/docs/doctrees/en docs build/docs/html
	$(BIN)/python $(SPHINX) -d build/docs/doctrees/de -D language=de docs build/docs/html/de
	$(BIN)/gruebler explore --site build/docs/html/explore --jobs 2
	$(BIN)/python docs/builder/links.py build/docs/html

# Of the site that is there; without one it is built first.
handbook: $(VENV)/.docs
	@test -e build/docs/html/de/index.html || $(MAKE) docs
	$(BIN)/python docs/builder/handbook.py build/docs/html build/docs/gruebler-handbook.pdf
	$(BIN)/python docs/builder/handbook.py build/docs/html/de build/docs/gruebler-handbuch.pdf --lang de

messages: $(READY)
	$(BIN)/python -m tests.messages

# The widget is dragged in real notebooks, whose servers are too large for the fast tests.
slow: $(READY)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check jupyterlab marimo
	$(BIN)/python -m pytest -q -m slow
	GRUEBLER_NEW_EXAMPLES=1 $(BIN)/python $(TESTED)

torture: $(READY)
	$(BIN)/python -m tests.torture --inputs 5000 --interrupts 200 --kills 300

ROOM   ?= mobility
NUMBER ?= 20
mutants: $(READY)
	$(BIN)/python -m tests.mutation $(ROOM) --number $(NUMBER)

# The wheel holds the files of the source tree, which `make test` tries; what depends on being installed is tried here. What
# it needs comes from the environment of the tests: with the versions it asks for it is installed by the targets below.
SITE = import sysconfig; print(sysconfig.get_path("purelib"))
wheel-test: $(READY)
	rm -rf build/wheel
	$(BIN)/python -m build --wheel --outdir build/wheel . >/dev/null
	$(BIN)/python .ci/wheel_files.py build/wheel/*.whl
	$(PYTHON) -m venv build/wheel/venv
	build/wheel/venv/bin/python -m pip install --quiet --disable-pip-version-check --no-deps build/wheel/*.whl
	$(BIN)/python -c '$(SITE)' > "$$(build/wheel/venv/bin/python -c '$(SITE)')/what_it_needs.pth"
	cd build/wheel && venv/bin/python $(TESTED) -c ../../pyproject.toml --rootdir ../.. -o cache_dir=.cache \
		$(addprefix ../../tests/,core cli/test_cli.py cli/test_languages.py teaching/exercises/test_tables.py test_front_door.py)

# What is decided by rounding shows when other kernels of the linear algebra round otherwise; `make test` has those that
# this processor chooses.
NUMERIC := $(addprefix tests/,machines mechanics design/realisation $(addprefix design/synthesis/test_,\
	curves.py functions.py dead_centres.py positions.py))
test-blas: $(READY)
	for core in $$($(BIN)/python .ci/blas_core.py); do \
		echo "OpenBLAS with the kernels for $$core"; \
		OPENBLAS_CORETYPE=$$core $(BIN)/python $(TESTED) $(NUMERIC) \
			$(addprefix --ignore=,$(LEFT_OUT)) || exit 1; done

# What other versions of Python and of the packages could break, in a few minutes; BROAD=tests runs everything.
BROAD := $(addprefix tests/,cli/test_cli.py cli/test_analyse.py cli/test_structure_commands.py test_front_door.py \
	$(addprefix mechanics/,analysis fourbar kinematics linkages) $(addprefix structure/,chain isomorphism mobility) \
	teaching/catalog)
# Environments of their own, kept in build/.
NEWEST ?= $(PYTHON)
EXTRAS := $(addprefix tests/,structure/atlas/test_building.py structure/enumeration/test_schedulers.py \
	page/test_widget.py files/test_dxf.py)
# All but the package: beside something else that one core does.
lowest-packages:
	@mkdir -p build/lowest
	@test -x build/lowest/venv/bin/python || $(PYTHON) -m venv build/lowest/venv
	$(PYTHON) .ci/lowest.py > build/lowest/constraints.txt
	build/lowest/venv/bin/python -m pip install --quiet --disable-pip-version-check -r build/lowest/constraints.txt
test-lowest: lowest-packages
	build/lowest/venv/bin/python -m pip install --quiet --disable-pip-version-check -e ".[test]" \
		-c build/lowest/constraints.txt
	build/lowest/venv/bin/python $(TESTED) $(BROAD) $(EXTRAS) $(addprefix --ignore=,$(LEFT_OUT))

NEWEST_DIR = build/newest/$(shell $(NEWEST) -c "import sys; print('%d.%d' % sys.version_info[:2])")
test-newest:
	@mkdir -p $(NEWEST_DIR)
	@test -x $(NEWEST_DIR)/venv/bin/python || $(NEWEST) -m venv $(NEWEST_DIR)/venv
	$(NEWEST_DIR)/venv/bin/python -m pip install --quiet --disable-pip-version-check --upgrade -e ".[test]"
	$(NEWEST_DIR)/venv/bin/python $(TESTED) $(BROAD)

# For work on the C++ kernels: without pip's detour it takes as long as the compiler. The tools alone, so that the package
# may be in use meanwhile.
TOOLS = import tomllib; \
	print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["core"], sep="\n")
$(VENV)/.core: pyproject.toml
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -c '$(TOOLS)' | $(BIN)/python -m pip install --quiet --disable-pip-version-check -r /dev/stdin
	@touch $@

CORE := PATH="$(CURDIR)/$(BIN):$$PATH" cmake
# Of its headers Python knows better than cmake where they are.
HEADERS = import sysconfig; print(sysconfig.get_path("include"))
CORE_PYTHON = -DPython_EXECUTABLE=$(CURDIR)/$(BIN)/python -DPython_INCLUDE_DIR="$$($(BIN)/python -c '$(HEADERS)')"
core: $(VENV)/.core
	$(CORE) -S core -B build/core -G Ninja $(CORE_PYTHON) \
		-DCORE_FOLDER=$(CURDIR)/src/gruebler >/dev/null
	$(CORE) --build build/core
	$(CORE) --install build/core >/dev/null

# The compiler is needed by who changes the kernels of the page only, so no extra asks for it.
page: $(READY)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check ziglang==0.17.1 zopfli
	$(BIN)/python core/page/build.py
	cd explorer && npm ci --no-audit --no-fund --ignore-scripts && npm run build

test-core: $(READY)
	$(BIN)/python -m pytest -q tests/core

core-sanitize: $(VENV)/.core
	$(CORE) -S core -B build/core-sanitize -G Ninja -DCORE_PYTHON=OFF -DCORE_STANDALONE=ON -DCORE_SANITIZE=ON >/dev/null
	$(CORE) --build build/core-sanitize
	cd build/core-sanitize && PATH="$(CURDIR)/$(BIN):$$PATH" ctest --output-on-failure

# The package once more with another module; as a copy, since DuckDB opens no link that leads out of its folder. Exceptions are caught by the library of C++ that is loaded first.
SANITIZED := build/core-sanitize-python
core-sanitize-python: $(READY) $(VENV)/.core
	$(CORE) -S core -B $(SANITIZED) -G Ninja $(CORE_PYTHON) -DCMAKE_CXX_COMPILER=g++ -DCORE_SANITIZE=ON \
		-DCORE_FOLDER=$(CURDIR)/$(SANITIZED)/gruebler >/dev/null
	$(CORE) --build $(SANITIZED)
	rm -rf $(SANITIZED)/gruebler
	cp -r src/gruebler $(SANITIZED)/
	cp -r catalogs $(SANITIZED)/gruebler/
	cp -r docs/tables $(SANITIZED)/gruebler/
	rm -f $(SANITIZED)/gruebler/_core*.so
	$(CORE) --install $(SANITIZED) >/dev/null
	LD_PRELOAD="$$(g++ -print-file-name=libasan.so) $$(g++ -print-file-name=libstdc++.so)" ASAN_OPTIONS=detect_leaks=0 \
		PYTHONPATH=$(CURDIR)/$(SANITIZED) $(BIN)/python $(TESTED) $(addprefix tests/,core mechanics/kinematics \
		structure/enumeration structure/isomorphism structure/atlas)

bench: $(READY)
	$(BIN)/python -m benchmarks

# What takes longer is listed with its command.
evidence: $(READY)
	$(BIN)/python -m benchmarks.tables --check
	$(BIN)/python -m benchmarks.evidence

paper: $(READY)
	$(BIN)/python -m paper.fill build/paper

clean:
	rm -rf $(VENV) build dist src/gruebler/_core*.so src/gruebler/_core*.pyd
