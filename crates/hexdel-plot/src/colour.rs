//! Colours of pictures: the scale of angles and the palette of regions.

/// A colour: red, green and blue, 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

pub(crate) const WHITE: Rgb = Rgb([0xff; 3]);
pub(crate) const BLACK: Rgb = Rgb([0; 3]);

/// Text and axes.
pub(crate) const INK: Rgb = Rgb([0x22; 3]);

/// Angles beyond their bounds: red, which the scale does not touch.
pub(crate) const BEYOND: Rgb = Rgb([0xe0, 0x1e, 0x37]);

/// The bars of the histogram.
pub(crate) const BARS: Rgb = Rgb([0x6f, 0x8f, 0xaf]);

impl Rgb {
    /// The colour between `self` at 0 and `other` at 1.
    pub(crate) fn mix(self, other: Self, t: f64) -> Self {
        let channel = |i: usize| {
            let (from, to) = (f64::from(self.0[i]), f64::from(other.0[i]));
            (from + (to - from) * t).round() as u8
        };
        Self([channel(0), channel(1), channel(2)])
    }

    pub(crate) fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// The colour at `t` in 0 to 1 of a scale that is even to the eye, also
    /// without colour vision: dark blue, green, yellow.
    ///
    /// ```
    /// use hexdel_plot::Rgb;
    /// assert_eq!(Rgb::of_scale(0.5), Rgb([0x21, 0x91, 0x8c]));
    /// ```
    pub fn of_scale(t: f64) -> Self {
        let position = t.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
        let below = (position as usize).min(SCALE.len() - 2);
        SCALE[below].mix(SCALE[below + 1], position - below as f64)
    }
}

/// Colours of a scale from 0 to 1: five evenly spaced samples of viridis
/// (Smith and van der Walt 2015).
const SCALE: [Rgb; 5] = [
    Rgb([0x44, 0x01, 0x54]),
    Rgb([0x3b, 0x52, 0x8b]),
    Rgb([0x21, 0x91, 0x8c]),
    Rgb([0x5e, 0xc9, 0x62]),
    Rgb([0xfd, 0xe7, 0x25]),
];

/// The colour of the region of number `index`; every tenth is alike.
pub(crate) fn palette(index: usize) -> Rgb {
    const PALETTE: [Rgb; 10] = [
        Rgb([0x8d, 0xb4, 0xdc]),
        Rgb([0xf6, 0xb2, 0x6b]),
        Rgb([0x93, 0xc9, 0x88]),
        Rgb([0xc6, 0xa5, 0xd6]),
        Rgb([0xf3, 0xd9, 0x70]),
        Rgb([0x7f, 0xc8, 0xc4]),
        Rgb([0xe8, 0x9a, 0xa9]),
        Rgb([0xc2, 0xa3, 0x83]),
        Rgb([0xb9, 0xc1, 0x6a]),
        Rgb([0xb5, 0xb5, 0xb5]),
    ];
    PALETTE[index % PALETTE.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_passes_its_samples() {
        for (i, colour) in SCALE.into_iter().enumerate() {
            assert_eq!(Rgb::of_scale(i as f64 / 4.0), colour);
        }
        assert_eq!(Rgb::of_scale(-1.0), SCALE[0]);
        assert_eq!(Rgb::of_scale(7.0), SCALE[4]);
        assert_eq!(Rgb::of_scale(0.125), Rgb([0x40, 0x2a, 0x70]));
        assert_eq!(Rgb([1, 2, 255]).hex(), "#0102ff");
    }
}
