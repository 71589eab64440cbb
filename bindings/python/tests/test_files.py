"""Volume files and record streams."""

import os

import locus
import numpy as np
import pytest


@pytest.mark.parametrize("ending", [".mha", ".mhd", ".nrrd", ".nhdr"])
@pytest.mark.parametrize("dtype", ["uint8", "int16", "float32", "float64", "uint64"])
def test_volumes_come_back(tmp_path, random, ending, dtype):
    data = random.integers(0, 100, (3, 4, 5)).astype(dtype)
    path = tmp_path / f"a{ending}"
    locus.write_volume(path, data, spacing=(1, 2, 3), origin=(-1, 0, 1), compression=6 if ending == ".mha" else 0)
    found = locus.read_volume(path, keep=True)
    assert found.data.dtype == dtype and found.spacing == (1, 2, 3) and found.info.origin == (-1, 0, 1)
    np.testing.assert_array_equal(found.data, data)
    assert locus.read_volume(path).data.dtype == np.float32
    assert locus.read_volume_info(path).dims == (5, 4, 3)


def test_components_and_direction(tmp_path, random):
    data = random.random((2, 3, 4, 5)).astype(np.float32)
    turned = (0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    locus.write_volume(tmp_path / "a.mha", data, direction=turned)
    found = locus.read_volume(tmp_path / "a.mha")
    np.testing.assert_array_equal(found.data, data)
    assert found.info.direction == turned and found.info.components == 2


def test_the_numbers_stay_where_the_library_read_them(tmp_path):
    locus.write_volume(tmp_path / "a.mha", np.arange(24, dtype=np.float32).reshape(2, 3, 4))
    data = locus.read_volume(tmp_path / "a.mha").data
    assert not data.flags.owndata and not data.flags.writeable and data.flags.c_contiguous
    part = data[1:, 1]
    del data
    # The memory lives as long as any view of it.
    np.testing.assert_array_equal(part, [[16, 17, 18, 19]])
    with pytest.raises(ValueError):
        part[0] = 1


def test_raw_files(tmp_path):
    data = np.arange(60, dtype=">i2").reshape(3, 4, 5)
    (tmp_path / "a.raw").write_bytes(b"head" + data.tobytes())
    raw = locus.Raw((3, 4, 5), ">i2", offset=4, spacing=(1, 1, 2))
    found = locus.read_volume(tmp_path / "a.raw", raw=raw)
    np.testing.assert_array_equal(found.data, data)
    assert found.spacing == (1, 1, 2)
    np.testing.assert_array_equal(locus.read_volume(tmp_path / "a.raw", raw=raw, keep=True).data, data)
    with pytest.raises(ValueError, match="complex"):
        locus.read_volume(tmp_path / "a.raw", raw=locus.Raw((1, 1, 1), complex))
    with pytest.raises(locus.FormatError, match="a.raw"):
        locus.read_volume(tmp_path / "a.raw", raw=locus.Raw((3, 4, 50), "i2"))


def test_errors_of_files(tmp_path):
    with pytest.raises(locus.IoError, match="none.mha") as caught:
        locus.read_volume(tmp_path / "none.mha")
    assert isinstance(caught.value, OSError) and caught.value.name == "LOCUS_E_IO"
    with pytest.raises(locus.OutOfMemoryError):
        locus.write_volume(tmp_path / "a.mha", np.zeros((9, 9, 9)))
        locus.read_volume(tmp_path / "a.mha", memory_limit=100)
    with pytest.raises(ValueError, match="complex128"):
        locus.write_volume(tmp_path / "a.mha", np.zeros((2, 2, 2), complex))
    with pytest.raises(locus.ArgumentError, match="ending|a.xyz"):
        locus.write_volume(tmp_path / "a.xyz", np.zeros((2, 2, 2)))


POSTS = "when,lat,lon,text\n1700000000,48.5,2.25,Bonjour\nnever,1,2,bad\n1700000001,-1,3,Hello\n"


def test_records(tmp_path):
    path = tmp_path / "posts.csv"
    path.write_text(POSTS)
    bad = []
    reader = locus.Records(path, time_column="when", batch=1, bad_line=lambda line, reason: bad.append((line, reason)))
    batches = list(reader)
    assert [len(batch) for batch in batches] == [1, 1]
    found = np.concatenate(batches)
    assert found["text"].tolist() == [b"Bonjour", b"Hello"] and found["latitude"].tolist() == [48.5, -1]
    assert found["time"].tolist() == [1700000000_000000, 1700000001_000000]
    assert [line for line, _ in bad] == [3] and reader.stats.bad == 1 and reader.stats.records == 2
    points = locus.Records(path, "point32", time_column="when").read()
    assert points.dtype == locus.POINT32 and points["longitude"].tolist() == [2.25, 3]
    store = locus.Store()
    store.insert(points, 1700000002_000000)
    assert len(store) == 2
    with pytest.raises(locus.FormatError, match="line 3|never"):
        reader = locus.Records(path, time_column="when", refuse_bad_lines=True)
        for _ in range(3):
            reader.read()
    with pytest.raises(ZeroDivisionError):
        locus.Records(path, time_column="when", bad_line=lambda line, reason: 1 / 0).read()
    with pytest.raises(locus.IoError, match="none.csv"):
        locus.Records(tmp_path / "none.csv")


def test_records_from_a_descriptor(tmp_path):
    (tmp_path / "posts.ndjson").write_text('{"time": 1700000000, "lat": 1, "lon": 2, "text": "x"}\n')
    descriptor = os.open(tmp_path / "posts.ndjson", os.O_RDONLY)
    try:
        assert len(locus.Records(descriptor, format="ndjson").read()) == 1
    finally:
        os.close(descriptor)
