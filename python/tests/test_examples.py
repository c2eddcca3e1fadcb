"""The examples."""

import importlib.util
import pathlib
import sys

import numpy as np
import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"


def load(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def test_poisson_converges_at_second_order():
    pytest.importorskip("scipy")
    pytest.importorskip("skfem")
    poisson = load("poisson")
    coarse, fine = poisson.table((0.3, 0.1))
    for i in (2, 3):
        order = np.log(coarse[i] / fine[i]) / np.log(coarse[0] / fine[0])
        assert 1.7 < order < 2.6, order


@pytest.mark.filterwarnings("ignore:repaired")
def test_groundwater(tmp_path, capsys):
    for package in ("geopandas", "scipy", "matplotlib"):
        pytest.importorskip(package)
    groundwater = load("groundwater")
    groundwater.main(tmp_path)
    assert "cells" in capsys.readouterr().out
    assert (tmp_path / "python-groundwater.png").read_bytes().startswith(b"\x89PNG")
    soils = groundwater.catchment()
    mesh = groundwater.mesh_of(soils)
    for row, shape in enumerate(soils.geometry):
        assert mesh.quality().area[mesh.region_of_triangle == row].sum() == pytest.approx(shape.area, rel=1e-9)
    for place, _ in groundwater.WELLS:
        assert (mesh.vertices == place).all(axis=1).sum() == 1
    # All that is recharged and not pumped leaves through the lake.
    heads = groundwater.heads_of(mesh, soils)
    assert np.isfinite(heads).all()


def test_gallery(tmp_path, capsys):
    pytest.importorskip("matplotlib")
    gallery = load("gallery")
    gallery.main(tmp_path, ("two-close", "plane", "letters"))
    pictures = sorted(path.name for path in tmp_path.iterdir())
    wanted = [f"{name}-{method}.png" for name in ("plane", "two-close") for method in ("compact", "templates")]
    assert pictures == sorted(["letters-compact.png", *wanted])
    assert all((tmp_path / name).read_bytes().startswith(b"\x89PNG") for name in pictures)
    # Each line names a picture and the triangles that it shows.
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(pictures) and all(" triangles" in line for line in lines)
