//! Points to measure with, the same in every run; the last digits are those of the
//! system's sine and power.

use hexdel_geom::DVec2;

/// How the points are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Input {
    /// Evenly over the unit square.
    Uniform,
    /// In a hundred bell-shaped clusters of different width.
    Clustered,
    /// Their distance from the middle evenly spread over six decades.
    Contrast,
}

impl Input {
    pub(crate) const ALL: [Self; 3] = [Self::Uniform, Self::Clustered, Self::Contrast];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Clustered => "clustered",
            Self::Contrast => "contrast",
        }
    }

    /// `count` points.
    pub(crate) fn points(self, count: usize) -> Vec<DVec2> {
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        match self {
            Self::Uniform => (0..count).map(|_| DVec2::new(random.unit(), random.unit())).collect(),
            Self::Clustered => {
                let centres: Vec<_> = (0..100)
                    .map(|_| (DVec2::new(random.unit(), random.unit()), 0.003 + 0.03 * random.unit()))
                    .collect();
                (0..count)
                    .map(|i| {
                        let (centre, width) = centres[i % centres.len()];
                        // Sums of four: bell-shaped enough.
                        let mut bell = || (0..4).map(|_| random.unit() - 0.5).sum::<f64>();
                        centre + DVec2::new(bell(), bell()) * width
                    })
                    .collect()
            }
            Self::Contrast => (0..count)
                .map(|_| {
                    let (turn, distance) = (std::f64::consts::TAU * random.unit(), random.unit());
                    DVec2::from_angle(turn) * 10.0_f64.powf(-6.0 * distance)
                })
                .collect(),
        }
    }
}

/// xorshift64 (Marsaglia 2003).
struct Random(u64);

impl Random {
    /// A number in `[0, 1)`.
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
