/** Where the robot is predicted to be: the dashed outline of its footprint, apart from where it was last reported. */
import type { RobotBody } from '@farpoint/protocol';
import { BufferGeometry, Float32BufferAttribute, LineDashedMaterial, LineSegments } from 'three';

/** Of a robot that does not tell its outline, m. */
const USUAL: RobotBody['footprint'] = [
  { x: 0.25, y: 0.2 },
  { x: -0.25, y: 0.2 },
  { x: -0.25, y: -0.2 },
  { x: 0.25, y: -0.2 },
];
/** Above the floor, over the ring and the ways (near-ring.ts), m. */
const HEIGHT_M = 0.04;
/** The box's height, m: it is seen from beside as well. */
const BOX_M = 0.3;
const COLOUR = 0xc9b8ff;
/**
 * Nearer to the report than this, it would only flicker, m and rad. Chosen: not less than what the prediction may lead
 * by (LEAD_M and LEAD_RAD of motion-predictor.ts), so that the lead alone shows no second outline.
 */
const LEAST_M = 0.015;
const LEAST_RAD = 0.015;

export class RobotGhost {
  /** In the world's axes (REP-103), at base_link. */
  readonly object: LineSegments<BufferGeometry, LineDashedMaterial>;
  #body: RobotBody | null | undefined;

  constructor() {
    const material = new LineDashedMaterial({
      color: COLOUR,
      dashSize: 0.06,
      gapSize: 0.04,
      transparent: true,
      opacity: 0.9,
    });
    this.object = new LineSegments(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.visible = false;
    this.body = null;
  }

  /** The robot's outline; `null` while it is not known. */
  set body(body: RobotBody | null) {
    if (body === this.#body) return;
    this.#body = body;
    const corners = body?.footprint ?? USUAL;
    const ends = corners.flatMap((corner, i) => {
      const next = corners[(i + 1) % corners.length] ?? corner;
      // A round robot has many corners: four uprights are enough to see a box.
      const isPost = i % Math.ceil(corners.length / 4) === 0;
      const edge = (z: number) => [corner.x, corner.y, z, next.x, next.y, z];
      const post = [corner.x, corner.y, HEIGHT_M, corner.x, corner.y, BOX_M];
      return [...edge(HEIGHT_M), ...edge(BOX_M), ...(isPost ? post : [])];
    });
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(ends, 3));
    this.object.computeLineDistances();
  }

  /** Whether nearer points do not hide it. */
  set onTop(onTop: boolean) {
    this.object.material.depthTest = !onTop;
  }

  hide(): void {
    this.object.visible = false;
  }

  /** @param offM and offRad: from where the robot was last reported */
  show(x: number, y: number, z: number, yaw: number, offM: number, offRad: number): void {
    this.object.visible = offM > LEAST_M || Math.abs(offRad) > LEAST_RAD;
    this.object.position.set(x, y, z);
    this.object.rotation.z = yaw;
  }
}
