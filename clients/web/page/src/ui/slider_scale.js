const STEPS = 1000;
const WIDE = 20; // from this ratio of the end to the scene's value on a scale of positive numbers is logarithmic
const TINY = 1e-12;

/**
 * How a slider of 0..1000 stands for a number. Logarithmic for positive numbers of a wide range, else linear. Ranges
 * without ends are given some, around `around`: a hundredth to a hundredfold where it is positive, else its double size
 * to either side.
 */
export class SliderScale {
  static steps = STEPS;

  constructor(minimum, maximum, around) {
    if (minimum >= 0 && around > 0 && maximum / around >= WIDE) {
      this.logarithmic = true;
      this.low = Math.max(minimum, around / 100);
      this.high = Math.min(maximum, around * 100);
    } else {
      const size = Math.abs(around) || 1;
      this.logarithmic = false;
      this.low = Number.isFinite(minimum) ? minimum : Math.min(around, maximum) - 2 * size;
      this.high = Number.isFinite(maximum) ? maximum : Math.max(around, this.low) + 2 * size;
    }
  }

  /** The number at a place of the slider, with three digits, and the range's own ends. */
  value(place) {
    if (place <= 0) return this.low;
    if (place >= STEPS) return this.high;
    const part = place / STEPS;
    if (this.logarithmic) return tidy(this.low * (this.high / this.low) ** part, 3);
    const step = 10 ** Math.floor(Math.log10((this.high - this.low) / STEPS) + TINY);
    return tidy(Math.round((this.low + part * (this.high - this.low)) / step) * step, 12);
  }

  /** The place of a number; those outside are at an end. */
  place(value) {
    const part = this.logarithmic
      ? Math.log(Math.max(value, Number.MIN_VALUE) / this.low) / Math.log(this.high / this.low)
      : (value - this.low) / (this.high - this.low);
    return Math.round(STEPS * Math.min(Math.max(part || 0, 0), 1));
  }
}

const tidy = (value, digits) => Number(value.toPrecision(digits));
