"""What the library tells in passing, printed where notes go."""

from logging import getLogger

from windopt.cli.terminal import overheard


def test_what_the_library_logs_is_overheard_for_a_while(capsys):
    logger = getLogger("windopt.somewhere")
    before = logger.level, list(logger.handlers)
    logger.info("too early")
    with overheard(logger):
        logger.info("%d flights [m]", 3)
        logger.debug("too fine")
    logger.info("too late")
    assert capsys.readouterr() == ("", "3 flights [m]\n")
    assert (logger.level, list(logger.handlers)) == before
