//! A symmetric positive definite matrix of 2x2 blocks, stored from each row's
//! first non-zero block to the diagonal, and its Cholesky factorisation.
//!
//! In a patch numbered ring by ring the profile is a fraction of the full
//! triangle; the factor fills only the profile (George & Liu, "Computer
//! Solution of Large Sparse Positive Definite Systems", chapter 4).

use hexdel_geom::DVec2;

/// The matrix, its factor, and their storage, reused from solve to solve.
#[derive(Debug, Default)]
pub(crate) struct Skyline {
    /// First stored column of each row; even.
    first: Vec<usize>,
    /// Index in `a` of each row's first stored entry.
    start: Vec<usize>,
    /// Entries, row by row from `first` to the diagonal.
    a: Vec<f64>,
    /// The factor, same layout; its diagonal is stored inverted.
    l: Vec<f64>,
}

impl Skyline {
    /// Lays out a zero matrix; `first_block[i]` is the first block column of
    /// block row `i`, at most `i`.
    pub(crate) fn reset(&mut self, first_block: &[u32]) {
        self.first.clear();
        self.start.clear();
        let mut at = 0;
        for (i, &f) in first_block.iter().enumerate() {
            let f = 2 * f as usize;
            for row in [2 * i, 2 * i + 1] {
                self.first.push(f);
                self.start.push(at);
                at += row - f + 1;
            }
        }
        self.a.clear();
        self.a.resize(at, 0.0);
    }

    /// Adds `g h^T` to block (i, j), `j <= i` and inside the profile.
    #[inline]
    pub(crate) fn add(&mut self, i: usize, j: usize, g: DVec2, h: DVec2) {
        let r0 = self.start[2 * i] + 2 * j - self.first[2 * i];
        let r1 = self.start[2 * i + 1] + 2 * j - self.first[2 * i];
        self.a[r0] += g.x * h.x;
        self.a[r1] += g.y * h.x;
        self.a[r1 + 1] += g.y * h.y;
        if i != j {
            self.a[r0 + 1] += g.x * h.y;
        }
    }

    /// Solves `(A + shift I) x = b` in place of `b`.
    ///
    /// # Complexity
    ///
    /// Sum of the squared row lengths.
    pub(crate) fn solve(&mut self, shift: f64, x: &mut [f64]) {
        let n = self.first.len();
        self.l.clear();
        self.l.extend_from_slice(&self.a);
        for i in 0..n {
            let (fi, si) = (self.first[i], self.start[i]);
            let (done, rest) = self.l.split_at_mut(si);
            let row = &mut rest[..=i - fi];
            for j in fi..i {
                let fj = self.first[j];
                let other = &done[self.start[j]..=self.start[j] + j - fj];
                let f = fi.max(fj);
                let s = dot(&row[f - fi..j - fi], &other[f - fj..j - fj]);
                row[j - fi] = (row[j - fi] - s) * other[j - fj];
            }
            let (head, diagonal) = row.split_at_mut(i - fi);
            let d = diagonal[0] + shift - dot(head, head);
            // The shift is positive, so is d but for rounding.
            diagonal[0] = 1.0 / d.max(1e-3 * shift).sqrt();
            let s = dot(head, &x[fi..i]);
            x[i] = (x[i] - s) * diagonal[0];
        }
        for i in (0..n).rev() {
            let (fi, si) = (self.first[i], self.start[i]);
            x[i] *= self.l[si + i - fi];
            let xi = x[i];
            for (l, x) in self.l[si..si + i - fi].iter().zip(&mut x[fi..i]) {
                *x -= l * xi;
            }
        }
    }
}

/// The dot product, in four lanes in a fixed order.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let tail: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            lanes[k] += x[k] * y[k];
        }
    }
    (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]) + tail
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_banded_system() {
        let n = 9;
        let first: Vec<u32> = (0..n as u32).map(|i| i.saturating_sub(2)).collect();
        let mut m = Skyline::default();
        m.reset(&first);
        let g = |i: usize, s: f64| DVec2::new((i as f64 * 1.3 + s).sin(), (i as f64 * 0.7 - s).cos());
        let mut full = vec![vec![0.0; 2 * n]; 2 * n];
        for i in 2..n {
            let vs = [i - 2, i - 1, i];
            for &a in &vs {
                for &b in &vs {
                    let (ga, gb) = (g(a, 0.2 * i as f64), g(b, 0.2 * i as f64));
                    if b <= a {
                        m.add(a, b, ga, gb);
                    }
                    for (r, x) in [ga.x, ga.y].into_iter().enumerate() {
                        for (c, y) in [gb.x, gb.y].into_iter().enumerate() {
                            full[2 * a + r][2 * b + c] += x * y;
                        }
                    }
                }
            }
        }
        let b: Vec<f64> = (0..2 * n).map(|i| (i as f64).sin()).collect();
        let mut x = b.clone();
        m.solve(0.1, &mut x);
        for i in 0..2 * n {
            let s: f64 = (0..2 * n).map(|j| full[i][j] * x[j]).sum::<f64>() + 0.1 * x[i];
            assert!((s - b[i]).abs() < 1e-12, "row {i}");
        }
    }
}
