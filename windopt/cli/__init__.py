"""The command line: one module per command, and one door that turns mistakes into exit codes."""

import sys

INTERRUPTED = 130


def main() -> None:
    """Run the command line.

    Exits with 0 when done, 1 where no plan exists or a check failed, 2 on bad input, 130 where
    the user stops it before there is an answer.
    """
    try:
        _run()  # libraries load for a moment, in which the user may think better of it
    except KeyboardInterrupt:
        print("Stopped before there was an answer.", file=sys.stderr)
        sys.exit(INTERRUPTED)


def _run() -> None:
    from windopt.cli.app import app
    from windopt.cli.outcome import BAD_INPUT, FAILED
    from windopt.cli.terminal import complain
    from windopt.errors import FailedCheck, InvalidInput, MissingExtra

    try:
        app()
    except (InvalidInput, MissingExtra) as mistake:
        complain(str(mistake))
        sys.exit(BAD_INPUT)
    except OSError as mistake:
        complain(f"{mistake.filename or 'File'}: {mistake.strerror or mistake}")
        sys.exit(BAD_INPUT)
    except FailedCheck as failure:
        complain(str(failure))
        sys.exit(FAILED)
