"""`python -m ecm_extract` is `ecm-extract`, for environments whose scripts are not on the path."""

from __future__ import annotations

from ecm_extract.cli import main

if __name__ == "__main__":
    main()
