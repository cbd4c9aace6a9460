"""One file a rule: `RULE` says what it is, `check` yields its findings."""
