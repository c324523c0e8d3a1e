class LSystemError(ValueError):
    """A system, a file or a value that cannot be used, or a limit that is passed. The message is for people;
    `diagnostics` has the errors and warnings one by one, each a `Problem`."""

    def __init__(self, message, diagnostics=()):
        super().__init__(message)
        self.diagnostics = list(diagnostics)
