"""What a mesh was found to keep."""

from __future__ import annotations

import json
from typing import Any


class Certificate:
    """What a mesh was found to keep, from its coordinates and indices alone.

    Every finding is an attribute: ``min_angle_deg``, ``max_angle_deg``, ``delaunay``,
    ``manifold``, ``disk``, ``inputs``, ``inputs_kept``, ``out_of_bounds``,
    ``shortest_edge``, ``violations`` and more; `as_dict` has all of them.

    Examples
    --------
    >>> import hexdel
    >>> certificate = hexdel.mesh([(0, 0), (1, 0)]).certificate
    >>> certificate.holds, certificate.delaunay, certificate.inputs_kept
    (True, True, 2)
    >>> certificate.max_angle_deg <= 90 + 1e-9
    True
    """

    __slots__ = ("_entries", "_holds", "_missing")
    _entries: dict[str, Any]
    _holds: bool
    _missing: tuple[int, ...]

    def __init__(self, text: str, holds: bool, missing: tuple[int, ...] = ()) -> None:
        object.__setattr__(self, "_entries", json.loads(text))
        object.__setattr__(self, "_holds", bool(holds))
        object.__setattr__(self, "_missing", tuple(missing))

    @property
    def holds(self) -> bool:
        """Whether all that was asked for is so.

        Of a mesh with segments, triangles at corners of the input narrower than the
        bound are exempt: `Mesh.exempt` lists them.
        """
        return self._holds

    @property
    def missing_segments(self) -> tuple[int, ...]:
        """Segments that are no unions of edges, by index."""
        return self._missing

    @property
    def bounds(self) -> tuple[float, float]:
        """The smallest and the largest angle allowed, degrees."""
        bounds = self._entries["bounds"]
        return bounds["min_deg"], bounds["max_deg"]

    def as_dict(self) -> dict[str, Any]:
        """All findings by name, a copy."""
        entries: dict[str, Any] = json.loads(json.dumps(self._entries))
        return {"holds": self._holds, **entries, "missing_segments": list(self._missing)}

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self._entries:
            return self._entries[name]
        raise AttributeError(f"a certificate has no {name!r}: as_dict() has all that there is")

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("certificates are immutable")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._entries})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Certificate) and self.as_dict() == other.as_dict()

    def __hash__(self) -> int:
        return hash(json.dumps(self._entries, sort_keys=True))

    def __reduce__(self) -> tuple[Any, ...]:
        return Certificate, (json.dumps(self._entries), self._holds, self._missing)

    def __bool__(self) -> bool:
        return self._holds

    def _rows(self) -> list[tuple[str, str]]:
        e = self._entries
        low, high = self.bounds
        faults = {
            "out of bounds": e["out_of_bounds"],
            "clockwise or flat": e["not_counter_clockwise"],
            "malformed": e["malformed"],
            "not finite": e["not_finite"],
            "segments missing": len(self._missing),
        }
        rows = [
            ("mesh", f"{e['vertices']} vertices, {e['triangles']} triangles"),
            (
                "angles",
                f"{e['min_angle_deg']:.4f} to {e['max_angle_deg']:.4f} degrees (bounds {low:g} to {high:g})",
            ),
            ("Delaunay", "yes" if e["delaunay"] else f"no, {e['non_delaunay_edges']} edges are not"),
            ("topology", "one disk" if e["disk"] else "manifold" if e["manifold"] else "not manifold"),
            ("inputs", f"{e['inputs_kept']} of {e['inputs']} are vertices"),
            ("shortest edge", f"{e['shortest_edge']:.6g}"),
        ]
        rows += [(name, str(count)) for name, count in faults.items() if count]
        if e["rounding_limited"]:
            worst = e["worst_rounding_excess_deg"]
            rows.append(("limited by rounding", f"{e['rounding_limited']} triangles, by up to {worst:.1e} degrees"))
        return rows

    def __repr__(self) -> str:
        rows = [("certified" if self._holds else "DOES NOT HOLD", ""), *self._rows()]
        return "\n".join(f"{name:<20}{value}".rstrip() for name, value in rows)

    def _repr_html_(self) -> str:
        title = "certified" if self._holds else "does not hold"
        rows = "".join(f"<tr><th>{name}</th><td>{value}</td></tr>" for name, value in self._rows())
        return f"<table><caption>{title}</caption>{rows}</table>"
