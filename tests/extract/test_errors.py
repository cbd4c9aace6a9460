import pickle

import pytest

from ecm_extract.errors import (
    ConfigError,
    EcmError,
    GitError,
    InputError,
    RefError,
    ToolError,
    TreeError,
    TreeReadError,
)

ERRORS: list[tuple[EcmError, int]] = [
    (EcmError("m"), 3),
    (InputError("m", "h"), 2),
    (TreeError("m", "h"), 2),
    (RefError("m", "h"), 2),
    (TreeReadError("a.py", "too-large", "m", "h"), 2),
    (ConfigError("ecm.toml", 3, "extract.x", "m"), 2),
    (ToolError("m"), 3),
    (GitError("m", "h"), 2),
]


@pytest.mark.parametrize(("error", "status"), ERRORS, ids=lambda value: type(value).__name__)
def test_errors(error: EcmError, status: int) -> None:
    """Every error knows its exit status, shows its hint and survives the way back from a worker."""
    assert error.exit_status == status
    assert str(error) == (f"{error.message}\n{error.hint}" if error.hint else error.message)
    back = pickle.loads(pickle.dumps(error))
    assert (type(back), str(back), vars(back)) == (type(error), str(error), vars(error))
