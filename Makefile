# Everything runs in .venv, made here from any Python of 3.11 or newer. A second run installs nothing.

VENV := .venv
BIN := $(VENV)/bin
DEMO := build/demo
REGISTRY_DEMO := build/registry-demo

NEW_ENOUGH := import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))
PYTHON ?= $(shell for each in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$each -c "$(NEW_ENOUGH)" 2>/dev/null && echo $$each && break; done)
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet

.DEFAULT_GOAL := help
.PHONY: help demo registry-demo test check format schemas corpus path-a clean

help: ## Show this list.
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile

demo: $(VENV)/.run ## Read the demo robot, print the summary and one manifest.
	@$(BIN)/ecm-extract fixtures/demo_robot -o $(DEMO)
	@echo; echo "The first lines of one manifest:"; echo
	@find $(DEMO) -name '*.ecm.yaml' | sort | head -n 1 | xargs head -n 40

registry-demo: $(VENV)/.dev ## Publish, refuse, migrate, promote, resolve over a registry of its own.
	@sh fixtures/registry/demo.sh $(BIN)/ecm-extract $(REGISTRY_DEMO)

test: $(VENV)/.dev ## Run the tests, in two processes.
	@$(BIN)/python -m pytest --numprocesses 2 --dist worksteal

check: $(VENV)/.dev ## Lint, formatting, types, direction of imports.
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check
	@$(BIN)/mypy
	@$(BIN)/lint-imports

format: $(VENV)/.dev ## Format the code and fix what lint can fix.
	@$(BIN)/ruff check --fix
	@$(BIN)/ruff format

schemas: $(VENV)/.dev ## Write golden files and JSON Schemas anew.
	@$(BIN)/python -m pytest --update-golden

corpus: $(VENV)/.run ## Judge the documented bugs anew: make corpus CLONES=DIR
	@test -n "$(CLONES)" || { echo "Name the folder of the clones: make corpus CLONES=DIR" >&2; exit 2; }
	@$(BIN)/ecm-extract blind --all --clones "$(CLONES)" -o corpus

path-a: $(VENV)/.dev ## Predictions of contracts beside what the middleware does.
	@$(BIN)/python benchmarks/path_a/run.py

clean: ## Remove the environment and what was built.
	rm -rf $(VENV) build

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer with venv is needed; name it: make PYTHON=..." >&2; exit 2; }
	@echo "making $(VENV) with $(PYTHON)" >&2
	@$(PYTHON) -m venv $(VENV)

$(VENV)/.run: pyproject.toml | $(BIN)/python
	@$(PIP) --editable .
	@touch $@

$(VENV)/.dev: pyproject.toml | $(BIN)/python
	@$(PIP) --editable '.[dev]'
	@touch $@ $(VENV)/.run
