/** Open3D trajectory files (`.log`): for each frame, a line of three numbers and a 4 × 4 camera-to-world matrix. */
import type { Pose, Quaternion } from '@farpoint/protocol';

export class TrajectoryError extends Error {
  override readonly name = 'TrajectoryError';
  /** Counted from 1. */
  readonly line: number;

  constructor(line: number, detail: string) {
    super(`trajectory, line ${line}: ${detail}`);
    this.line = line;
  }
}

/** How far a rotation may be from orthonormal: files round to six digits. */
const TOLERANCE = 1e-3;
const MAX_FRAMES = 1_000_000;

/**
 * @returns the pose of each frame's optical frame in the file's world, metres
 * @throws {TrajectoryError}
 */
export function parseTrajectoryLog(text: string): Pose[] {
  const lines = text
    .split('\n')
    .map((line, index) => ({ number: index + 1, words: line.trim().split(/\s+/) }))
    .filter(({ words }) => words[0] !== '');
  const poses: Pose[] = [];
  for (let at = 0; at < lines.length; at += 5) {
    const rows = lines.slice(at, at + 5);
    const head = rows[0] as { number: number; words: string[] };
    if (poses.length >= MAX_FRAMES) throw new TrajectoryError(head.number, `more than ${MAX_FRAMES} frames`);
    if (rows.length < 5) throw new TrajectoryError((rows.at(-1) ?? head).number, 'ends within a matrix');
    if (head.words.length !== 3)
      throw new TrajectoryError(head.number, `${head.words.length} numbers, 3 needed`);
    const m = rows.slice(1).map(({ number, words }) => {
      // Old Windows programs write exponents of three digits, which Number accepts.
      const row = words.map(Number);
      if (row.length !== 4 || !row.every(Number.isFinite)) {
        throw new TrajectoryError(number, 'not four numbers of a matrix row');
      }
      return row as [number, number, number, number];
    }) as [Row, Row, Row, Row];
    const fault = rotationFault(m);
    if (fault !== null) throw new TrajectoryError(head.number, fault);
    poses.push({
      position: { x: m[0][3], y: m[1][3], z: m[2][3] },
      orientation: quaternionOf(m),
    });
  }
  return poses;
}

type Row = [number, number, number, number];
type Matrix = [Row, Row, Row, Row];

function rotationFault(m: Matrix): string | null {
  const dot = (i: 0 | 1 | 2, j: 0 | 1 | 2) => m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j];
  for (const i of [0, 1, 2] as const) {
    for (const j of [0, 1, 2] as const) {
      if (Math.abs(dot(i, j) - (i === j ? 1 : 0)) > TOLERANCE) return 'the rotation is not orthonormal';
    }
  }
  const determinant =
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  if (determinant < 0) return 'the matrix mirrors';
  const [a, b, c, d] = m[3];
  return a === 0 && b === 0 && c === 0 && d === 1 ? null : 'the last row is not 0 0 0 1';
}

/** Shepperd's method: divides by the largest component. */
function quaternionOf(m: Matrix): Quaternion {
  const [[m00, m01, m02], [m10, m11, m12], [m20, m21, m22]] = m;
  const trace = m00 + m11 + m22;
  let q: Quaternion;
  if (trace >= Math.max(m00, m11, m22)) {
    q = { x: m21 - m12, y: m02 - m20, z: m10 - m01, w: 1 + trace };
  } else if (m00 >= m11 && m00 >= m22) {
    q = { x: 1 + m00 - m11 - m22, y: m01 + m10, z: m02 + m20, w: m21 - m12 };
  } else if (m11 >= m22) {
    q = { x: m01 + m10, y: 1 - m00 + m11 - m22, z: m12 + m21, w: m02 - m20 };
  } else {
    q = { x: m02 + m20, y: m12 + m21, z: 1 - m00 - m11 + m22, w: m10 - m01 };
  }
  const norm = Math.hypot(q.x, q.y, q.z, q.w);
  return { x: q.x / norm, y: q.y / norm, z: q.z / norm, w: q.w / norm };
}
