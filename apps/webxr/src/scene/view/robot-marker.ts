/** A plain outline of the robot and its heading. */
import {
  BoxGeometry,
  BufferGeometry,
  EdgesGeometry,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from 'three';

/** Footprint of a small wheeled robot, metres. */
const LENGTH = 0.5;
const WIDTH = 0.4;
const HEIGHT = 0.25;

export class RobotMarker {
  /** In the world's axes (REP-103), at base_link. */
  readonly object = new Group();
  readonly #outline: LineBasicMaterial;
  readonly #heading: MeshBasicMaterial;
  readonly #box: LineSegments;

  constructor() {
    this.#outline = new LineBasicMaterial({ color: 0x35c9b5, transparent: true, opacity: 0.8 });
    this.#heading = new MeshBasicMaterial({ color: 0x35c9b5, transparent: true, opacity: 0.7 });
    const box = new EdgesGeometry(new BoxGeometry(LENGTH, WIDTH, HEIGHT));
    const outline = new LineSegments(box, this.#outline);
    outline.position.z = HEIGHT / 2 + 0.03;
    const arrow = new BufferGeometry();
    arrow.setAttribute(
      'position',
      new Float32BufferAttribute([0.62, 0, 0.02, 0.4, 0.12, 0.02, 0.4, -0.12, 0.02], 3),
    );
    arrow.setIndex([0, 1, 2]);
    const heading = new Mesh(arrow, this.#heading);
    this.#box = outline;
    this.object.add(outline, heading);
    this.object.visible = false;
  }

  /** Whether it has a box of a usual robot's size: not where the robot's own outline is shown. */
  set boxed(boxed: boolean) {
    this.#box.visible = boxed;
  }

  /** Whether points that are nearer do not hide it. */
  set onTop(onTop: boolean) {
    this.#outline.depthTest = !onTop;
    this.#heading.depthTest = !onTop;
  }
}
