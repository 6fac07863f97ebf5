"""Certificates on the command line: proved on request, and written where they were asked for."""

from pathlib import Path

from windopt.cli.terminal import note, progress
from windopt.domain.plan import InspectionPlan
from windopt.errors import InvalidInput
from windopt.io.certificates import write_certificate
from windopt.planning.certification import certify
from windopt.result import Result


def require_new(path: Path | None, *, force: bool) -> None:
    """Refuse a file that cannot be written, before hours are spent on its content."""
    if path is None:
        return
    if path.is_dir():
        raise InvalidInput("--certificate", "to be a file", f"the folder {path}")
    if path.exists() and not force:
        raise InvalidInput("--certificate", "to be a new file unless --force is given", path)


def write_proof(
    result: Result[InspectionPlan],
    path: Path,
    folder: Path | None,
    *,
    time_limit: float,
    memory: float,
    force: bool,
) -> None:
    """Prove the bound of a plan and write the certificate to ``path`` and into ``folder``."""
    if result.solution is None:
        note(("There is no plan, and so no certificate.",))
        return
    note(("Proving the bound once more, for the certificate; Ctrl-C ends that.",))
    with progress("Proving the bound"):
        certificate = certify(result, time_limit=time_limit, memory=memory)
    if certificate.reason:
        proved = f"{certificate.proof.bound:.2f} s of the bound of {result.bound:.2f} s"
        lacking = f"The certificate proves {proved}"
        note((f"{lacking}. {certificate.reason}",))
    paths = [path] if folder is None else [path, folder / "certificate.json"]
    for each in paths:
        write_certificate(certificate, each, force=force)
    note((f"Certificate written to {', '.join(map(str, paths))}.",))
