"""Numbers equal the command's JSON bit for bit, and what follows from them holds for numpy's own matrices."""

import numpy as np
import pytest

import eigenring

CORNERS = [
    ("catmull-clark", ["-N", "3"], lambda s: s.at(3)),
    ("catmull-clark", ["-N", "4"], lambda s: s.at(4)),
    ("catmull-clark", ["-N", "20"], lambda s: s.at(20)),
    ("catmull-clark", ["--fan", "3"], lambda s: s.at(eigenring.Corner.fan(3))),
    ("catmull-clark", ["--dart", "-N", "5"], lambda s: s.at(eigenring.Corner.dart(5))),
    ("catmull-clark", ["--knots", "1,2,1,3", "--next", "1,1,1,1"], lambda s: s.at(4, [1, 2, 1, 3], next=[1] * 4)),
    ("doo-sabin", ["-N", "7"], lambda s: s.at(7)),
    ("lambda:optimal", ["-N", "6"], lambda s: s.at(6)),
    ("tension:order=6,u0=2", ["-N", "5"], lambda s: s.at(5)),
]


@pytest.mark.parametrize("spec, options, at", CORNERS)
def test_spectra_are_those_of_the_command(command, spec, options, at):
    printed = command("spectrum", "--scheme", spec, *options, "--format", "json")
    spectrum = at(eigenring.Scheme(spec)).spectrum()
    assert spectrum.json() == printed
    values = [complex(e["re"], e["im"]) for e in printed["eigenvalues"] for _ in range(e["multiplicity"])]
    assert spectrum.eigenvalues.tolist() == values
    assert len(values) == printed["points"]


def test_matrices_and_vectors_are_those_of_the_command(command):
    at = eigenring.Scheme("catmull-clark").at(7)
    printed = command("matrix", "--scheme", "catmull-clark", "-N", "7", "--rings", "2", "--format", "json")
    assert at.matrix(2).tolist() == printed["rows"]
    assert at.eigenvectors().json() == command("eigenvectors", "--scheme", "catmull-clark", "-N", "7")
    assert at.eigenvectors().right.tolist() == at.eigenvectors().json()["right"]


def test_certificates_are_those_of_the_command(command):
    for require in ("c1", "bounded", "strict", "hull"):
        printed = command("verify", "--scheme", "catmull-clark", "-N", "3", "--require", require, "--format", "json")
        assert eigenring.Scheme("catmull-clark").at(3).verify(require).json() == printed


def test_a_changed_certificate_is_not_confirmed():
    text = eigenring.Scheme("catmull-clark").at(6).verify().to_json()
    assert eigenring.Certificate.from_json(text).recheck() == ""
    changed = text.replace('"proven"', '"refuted"', 1)
    assert changed != text and eigenring.Certificate.from_json(changed).recheck() != ""


@pytest.mark.parametrize("valence", [3, 4, 5, 12])
def test_eigenvalues_are_those_of_numpy(valence):
    """The oracle is LAPACK on the whole matrix; defective zeros are what it knows to 1e-5 only."""
    at = eigenring.Scheme("catmull-clark").at(valence)
    expected = np.sort(np.abs(np.linalg.eigvals(at.matrix())))
    assert abs(np.sort(np.abs(at.spectrum().eigenvalues)) - expected).max() < 1e-5
    blocks = at.blocks()
    twice = [blocks[min(k, valence - k)] for k in range(valence)]
    blocks = np.concatenate([np.linalg.eigvals(block) for block in twice])
    assert abs(np.sort(np.abs(blocks)) - expected).max() < 1e-5


def test_maps_agree_with_finite_differences():
    """The Jacobian is that of the sampled points."""
    sample = eigenring.Scheme("catmull-clark").at(5).characteristic_map().sample(201)
    du = (sample.points[:, 2:, 1:-1] - sample.points[:, :-2, 1:-1]) * 100
    dv = (sample.points[:, 1:-1, 2:] - sample.points[:, 1:-1, :-2]) * 100
    by_differences = du[..., 0] * dv[..., 1] - dv[..., 0] * du[..., 1]
    assert abs(by_differences - sample.jacobians[:, 1:-1, 1:-1]).max() < 1e-4


def test_a_matrix_stands_for_its_scheme():
    at = eigenring.Scheme("catmull-clark").at(6)
    given = eigenring.Scheme.from_matrix(at.matrix()).at()
    assert given.valence == 6
    assert abs(given.spectrum().eigenvalues - at.spectrum().eigenvalues)[:10].max() < 1e-12
    with pytest.raises(eigenring.Error):
        given.verify()


def test_scheme_files_by_path_and_text(tmp_path):
    text = (
        'name = "cc"\nkind = "one-ring"\n[parameters]\na = { default = "3/2", range = ["0", "2"] }\n[rule]\nn = "3.."\n'
        'f1 = "1/4"\nf2 = "1/4"\nf3 = "1/4"\nd1 = "3/8"\nd2 = "3/8"\ne1 = "1/16"\ne2 = "1/16"\n'
        'alpha = "a/n"\nbeta = "1/(4*n)"\n'
    )
    path = tmp_path / "my, own.toml"
    path.write_text(text)
    expected = eigenring.Scheme("catmull-clark").at(5).matrix().tolist()
    for spec in (text, path, str(path)):
        scheme = eigenring.Scheme(spec)
        assert scheme.spec == "cc"
        assert np.allclose(scheme.at(5).matrix(), expected, atol=1e-15)
        assert scheme.at(5).verify().status == "proven"
    assert not np.allclose(scheme.set(a="5/4").at(5).matrix(), expected)


@pytest.mark.parametrize(
    "call",
    [
        lambda: eigenring.Scheme("catmul-clark"),
        lambda: eigenring.Scheme(3),
        lambda: eigenring.Scheme("kind = \n"),
        lambda: eigenring.Scheme("/nowhere/my.toml"),
        lambda: eigenring.Scheme("catmull-clark").at(2),
        lambda: eigenring.Scheme("catmull-clark").at(-1),
        lambda: eigenring.Scheme("catmull-clark").at(10**30),
        lambda: eigenring.Scheme("catmull-clark").at(5.0),
        lambda: eigenring.Scheme("catmull-clark").at(True),
        lambda: eigenring.Scheme("catmull-clark").at(float("nan")),
        lambda: eigenring.Scheme("catmull-clark").at(4, [1, 2, 3]),
        lambda: eigenring.Scheme("catmull-clark").at(4, [1, float("nan"), 3, 1]),
        lambda: eigenring.Scheme("catmull-clark").at(5).matrix(10**6),
        lambda: eigenring.Scheme("catmull-clark").at(5).verify("smooth"),
        lambda: eigenring.Scheme("catmull-clark").at(5).characteristic_map().sample(10**6),
        lambda: eigenring.Scheme("catmull-clark").at(5).characteristic_map().sample(1),
        lambda: eigenring.Scheme("catmull-clark").set(a=1),
        lambda: eigenring.Scheme.from_matrix(np.zeros((3, 4))),
        lambda: eigenring.Scheme.from_matrix(np.zeros((3, 3), dtype=np.float32)),
        lambda: eigenring.Scheme.from_matrix(np.zeros((4, 4), order="F")[:, ::2]),
        lambda: eigenring.Scheme.from_matrix(np.zeros((8, 8))[::2, ::2]),
        lambda: eigenring.Scheme.from_matrix(np.full((3, 3), np.nan)),
        lambda: eigenring.Scheme.from_matrix(np.zeros((3, 3, 3))),
        lambda: eigenring.Scheme.from_matrix([[1.0], [1.0, 2.0]]),
        lambda: eigenring.Certificate.from_json("{}"),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(eigenring.Error) as caught:
        call()
    assert isinstance(caught.value, ValueError)
    assert str(caught.value) and "\n" not in str(caught.value).strip()


def test_errors_say_what_is_accepted():
    with pytest.raises(eigenring.Error) as caught:
        eigenring.Scheme("catmull-clark").at(2)
    assert caught.value.accepted and caught.value.accepted in str(caught.value)


def test_progress_may_stop_the_work():
    class Enough(Exception):
        pass

    def progress(what, done, total):
        raise Enough

    certificate = eigenring.Scheme("catmull-clark").at(5)
    try:
        certificate.verify(progress=progress)
    except Enough:
        pass
    # the interpreter goes on
    assert certificate.verify().holds
