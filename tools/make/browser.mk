# The explorer's page in a real browser: playwright-core from npm, at the version that its lock file names, drives Debian's chromium.
# PICTURES=folder keeps screenshots; BROWSER_ONLY=map runs tests/browser/map.test.mjs alone.
BROWSER_MODULES := tests/browser/node_modules/.package-lock.json
BROWSER_TESTS := $(if $(BROWSER_ONLY),$(BROWSER_ONLY:%=tests/browser/%.test.mjs),$(sort $(wildcard tests/browser/*.test.mjs)))
$(BROWSER_MODULES): tests/browser/package-lock.json | $(call needs,browser)
	@npm ci --prefix tests/browser --no-audit --no-fund --silent
	@touch $@

.PHONY: browser-test
browser-test: $(EXAMPLE_explorer) $(BROWSER_MODULES) | $(call needs,browser) ## the explorer's page in Chromium
	$(STAGE) $(FLAVOUR)$@ env EXPLORER=$(EXAMPLE_explorer) $(if $(PICTURES),PICTURES=$(abspath $(PICTURES))) node --test --test-concurrency=1 $(BROWSER_TESTS)
CHECKS += browser-test
check: browser-test

# Both tiers under load: about two minutes and a half each. `make check` runs a small one, which asserts nothing about time.
EXPLORER_LOAD := /usr/bin/python3 tests/examples/explorer_load.py $(EXAMPLE_explorer)
.PHONY: explorer-load check-explorer-load
explorer-load: $(EXAMPLE_explorer) $(BROWSER_MODULES) | $(call needs,browser) $(call needs,test) ## the explorer with 10 M records, 20,000 arrivals/s and 100 listeners; LOAD_FLAGS: see docs/explorer.md
	@$(EXPLORER_LOAD) --page $(LOAD_FLAGS)
	@$(EXPLORER_LOAD) --page --keep $(LOAD_FLAGS)
check-explorer-load: $(EXAMPLE_explorer) $(BROWSER_MODULES) | $(call needs,browser) $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ $(EXPLORER_LOAD) --records 200000 --rate 2000 --listeners 100 --seconds 4 --page 1 --keep
CHECKS += check-explorer-load
check: check-explorer-load

# What the page takes from npm packages, made anew and compared.
.PHONY: check-page-files
check-page-files: | $(call needs,browser)
	$(STAGE) $(FLAVOUR)$@ tests/browser/derived.sh $(OUT)/page-files
CHECKS += check-page-files
check: check-page-files
