//! What a summary says of the edges of the Voronoi dual, if a bound was given.

use hexdel::geom::certificate::DualCheck;

/// A line, and one more with the worst edge if some are too short.
pub(super) fn dual_edges_line(found: Option<&DualCheck>) -> String {
    let Some(DualCheck { min_ratio, edges, below, excused, worst: Some(worst), .. }) = found else {
        return String::new();
    };
    let excused =
        if *excused > 0 { format!(", {excused} at exempt triangles excused") } else { String::new() };
    if *below == 0 {
        return format!(
            "dual edges at least {:.4} of their edges, asked for {min_ratio}{excused}\n",
            // What is excused is not what is promised.
            if excused.is_empty() { worst.ratio } else { *min_ratio },
        );
    }
    let [a, b] = worst.ends;
    format!(
        "dual edges {below} of {edges} FAILED: shorter than {min_ratio} of their edges{excused}\n           \
         the shortest {:.4}, of the edge from ({}, {}) to ({}, {})\n",
        worst.ratio, a.x, a.y, b.x, b.y,
    )
}
