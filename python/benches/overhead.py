"""What Python adds to the call of the library, at 100,000 points.

python overhead.py [POINTS]
"""

from __future__ import annotations

import sys
import time

import hexdel


def main(count: int) -> None:
    """Prints seconds in the library, and around it."""
    points = hexdel.generate("uniform", count)
    print("| method | triangles | library, s | call, s | overhead |\n|---|---:|---:|---:|---:|")
    for method in ("templates", "simple"):
        for _ in range(3):
            begun = time.perf_counter()
            mesh = hexdel.mesh(points, method=method)
            call = time.perf_counter() - begun
            library = mesh.seconds["total"]
            overhead = 100 * (call / library - 1)
            print(f"| {method} | {len(mesh)} | {library:.3f} | {call:.3f} | {overhead:.1f} % |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
