/**
 * Tests whether drawn points fit the expected distribution: the paper's weights, drawn successively without
 * replacement.
 *
 * In a large population, the draw is equivalent to "every point whose exponential clock of rate v rings before time
 * t", with t such that N clocks have rung. For large N, t hardly varies, the number of points drawn from a class is
 * normally distributed, and its mean and covariance are known (Rosén, "Asymptotic theory for successive sampling",
 * 1972). With π = 1 − exp(−v t) and Σπ = N, the mean of a class is Σπ. Its deviation is Σ(drawn − π) minus the
 * class's share of the total's excess, because the total is fixed. The statistic is the squared deviation in units of
 * that covariance.
 */

export interface WeightParameters {
  lambda: number;
  epsilon: number;
  /** D, metres. */
  nearDistance: number;
}

/** The paper's v (equations 4 and 5) for each depth, scaled so that the largest is 1. */
export function depthWeights(depths: ArrayLike<number>, parameters: WeightParameters): Float64Array {
  const { lambda, epsilon, nearDistance } = parameters;
  let deepest = 0;
  for (let i = 0; i < depths.length; i++) deepest = Math.max(deepest, depths[i] as number);
  const weights = Float64Array.from(depths, (z) => 1 / ((z / deepest) ** lambda + epsilon));
  let heaviest = 0;
  for (const weight of weights) heaviest = Math.max(heaviest, weight);
  return weights.map((weight, i) => ((depths[i] as number) < nearDistance ? 1 : weight / heaviest));
}

/**
 * For one draw: the expected number of points, its variance if the total were free, and its derivative with respect
 * to time.
 */
interface DepthClass {
  mean: number;
  variance: number;
  slope: number;
}

/** Counts draws by depth class, and compares them with the distribution of independent draws of `count` points. */
export class SamplingFit {
  readonly #classOf: Uint16Array;
  readonly #classes: DepthClass[];
  readonly #counts: Float64Array;
  #draws = 0;

  /** @param weights the points' v; `count` points are drawn each time */
  constructor(depths: ArrayLike<number>, weights: Float64Array, count: number, classes = 20) {
    const time = ringingTime(weights, count);
    const variance = weights.map((v) => Math.exp(-v * time) * -Math.expm1(-v * time));
    const total = variance.reduce((sum, value) => sum + value, 0);
    // Classes of equal variance, ordered by depth.
    const order = Uint32Array.from(depths, (_, i) => i).sort(
      (a, b) => (depths[a] as number) - (depths[b] as number),
    );
    this.#classOf = new Uint16Array(depths.length);
    this.#classes = Array.from({ length: classes }, () => ({ mean: 0, variance: 0, slope: 0 }));
    this.#counts = new Float64Array(classes);
    let before = 0;
    for (const i of order) {
      const at = Math.min(classes - 1, Math.floor((before / total) * classes));
      const its = this.#classes[at] as DepthClass;
      const v = weights[i] as number;
      this.#classOf[i] = at;
      its.mean += -Math.expm1(-v * time);
      its.variance += variance[i] as number;
      its.slope += v * Math.exp(-v * time);
      before += variance[i] as number;
    }
  }

  /** Counts one draw: the indices of its points. */
  add(chosen: Iterable<number>): void {
    for (const index of chosen) {
      const at = this.#classOf[index] as number;
      this.#counts[at] = (this.#counts[at] as number) + 1;
    }
    this.#draws++;
  }

  /** The probability of a deviation at least as large as the observed one if the draws are correct. */
  pValue(): number {
    const classes = this.#classes;
    const slopes = classes.reduce((sum, { slope }) => sum + slope, 0);
    const variances = classes.reduce((sum, { variance }) => sum + variance, 0);
    // The counts add up to a constant, so one of them carries no information.
    const free = classes.length - 1;
    const covariance = Array.from({ length: free }, (_, j) =>
      Array.from({ length: free }, (_, k) => {
        const a = classes[j] as DepthClass;
        const b = classes[k] as DepthClass;
        const own = j === k ? a.variance : 0;
        const shared = (b.slope * a.variance + a.slope * b.variance) / slopes;
        const excess = (a.slope * b.slope * variances) / slopes ** 2;
        return this.#draws * (own - shared + excess);
      }),
    );
    const deviation = Array.from(
      { length: free },
      (_, j) => (this.#counts[j] as number) - this.#draws * (classes[j] as DepthClass).mean,
    );
    const solved = solve(covariance, deviation);
    const statistic = deviation.reduce((sum, value, j) => sum + value * (solved[j] as number), 0);
    return chiSquareTail(statistic, free);
  }
}

/** The t with Σ(1 − exp(−v t)) = count, by bisection. */
function ringingTime(weights: Float64Array, count: number): number {
  const rung = (time: number) => weights.reduce((sum, v) => sum - Math.expm1(-v * time), 0);
  let high = 1;
  while (rung(high) < count) high *= 2;
  let low = 0;
  for (let step = 0; step < 60; step++) {
    const middle = (low + high) / 2;
    if (rung(middle) < count) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** Solves a symmetric positive definite system by Gaussian elimination. Modifies its arguments. */
function solve(matrix: number[][], right: readonly number[]): number[] {
  const n = right.length;
  const rows = matrix.map((row, i) => [...row, right[i] as number]);
  for (let pivot = 0; pivot < n; pivot++) {
    const from = rows[pivot] as number[];
    for (const to of rows.slice(pivot + 1)) {
      const factor = (to[pivot] as number) / (from[pivot] as number);
      for (let c = pivot; c <= n; c++) to[c] = (to[c] as number) - factor * (from[c] as number);
    }
  }
  const solution = new Array<number>(n).fill(0);
  for (let i = n - 1; i >= 0; i--) {
    const row = rows[i] as number[];
    let rest = row[n] as number;
    for (let c = i + 1; c < n; c++) rest -= (row[c] as number) * (solution[c] as number);
    solution[i] = rest / (row[i] as number);
  }
  return solution;
}

/**
 * P(X ≥ x) for a chi-square distributed X with `degrees` degrees of freedom, from the finite sums for integer
 * degrees.
 */
export function chiSquareTail(x: number, degrees: number): number {
  if (!(x > 0)) return 1;
  const half = x / 2;
  // Q(a + 1, y) = Q(a, y) + yᵃ e⁻ʸ / Γ(a + 1), starting from Q(1, y) = e⁻ʸ or Q(½, y) = erfc(√y).
  let a = degrees % 2 === 0 ? 1 : 0.5;
  let tail = degrees % 2 === 0 ? Math.exp(-half) : complementaryError(Math.sqrt(half));
  let term = degrees % 2 === 0 ? Math.exp(-half) * half : 2 * Math.sqrt(half / Math.PI) * Math.exp(-half);
  while (a < degrees / 2 - 1e-9) {
    tail += term;
    a += 1;
    term *= half / a;
  }
  return Math.min(1, tail);
}

/** erfc(x) for x ≥ 0: the series of erf below 3, the continued fraction above. */
function complementaryError(x: number): number {
  if (x < 3) {
    let term = x;
    let sum = x;
    for (let n = 1; n < 100; n++) {
      term *= (-x * x) / n;
      sum += term / (2 * n + 1);
    }
    return 1 - (2 / Math.sqrt(Math.PI)) * sum;
  }
  let fraction = x;
  for (let n = 60; n > 0; n--) fraction = x + n / 2 / fraction;
  return Math.exp(-x * x) / (Math.sqrt(Math.PI) * fraction);
}
