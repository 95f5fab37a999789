/** The robot's model in the scene, with its joints where they are. */
import { Group, type Material, Mesh, Quaternion, Vector3 } from 'three';
import { type FigureParts, readPlace } from './figure-parts.ts';

/** A link that moves, and where it is while its joint is at 0. */
interface Joint {
  node: Group;
  position: Vector3;
  turn: Quaternion;
  axis: Vector3;
  slides: boolean;
}

export class RobotFigure {
  /** At base_link, in the axes of REP-103. */
  readonly object = new Group();
  readonly #material: Material;
  readonly #moved = new Quaternion();
  #joints: Joint[] = [];

  constructor(material: Material) {
    this.#material = material;
  }

  /** Shows another model; the geometries stay their owner's. */
  set parts({ links, geometries }: FigureParts) {
    this.object.clear();
    const nodes = [this.object];
    const draw = (node: Group, link: number) => {
      const geometry = geometries[link];
      if (geometry) node.add(new Mesh(geometry, this.#material));
    };
    draw(this.object, 0);
    this.#joints = links.map(({ parent, place, axis, moves }) => {
      const [node, position, turn] = [new Group(), new Vector3(), new Quaternion()];
      readPlace(place, position, turn);
      (nodes[parent] as Group).add(node);
      draw(node, nodes.length);
      nodes.push(node);
      return { node, position, turn, axis: new Vector3(...axis).normalize(), slides: moves === 'slides' };
    });
    this.pose([]);
  }

  /** Allocates nothing. @param positions of the moving links: radians or metres; 0 where there is none */
  pose(positions: readonly number[]): void {
    const moved = this.#moved;
    for (let i = 0; i < this.#joints.length; i++) {
      const { node, position, turn, axis, slides } = this.#joints[i] as Joint;
      const at = positions[i] ?? 0;
      node.position.copy(position);
      node.quaternion.copy(turn);
      if (slides) node.translateOnAxis(axis, at);
      else node.quaternion.multiply(moved.setFromAxisAngle(axis, at));
    }
  }
}
