import fc from 'fast-check';
import { Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { MODEL_SCALE, TableModel } from './table-model.ts';

const hand = (at: Vector3, holds = true) => ({ holds, x: at.x, y: at.y, z: at.z });
const open = hand(new Vector3(), false);
const UP = new Vector3(0, 1, 0);

/** Where a place of the world, metres from the robot in the room's directions at first, is in the room. */
class Shown {
  turned = 0;
  readonly model = new TableModel();

  follow(a: ReturnType<typeof hand>, b: ReturnType<typeof hand>): void {
    this.model.follow(a, b);
    this.turned += this.model.turned;
  }

  at(place: Vector3): Vector3 {
    const { x, y, z, scale } = this.model;
    return place
      .clone()
      .multiplyScalar(scale)
      .applyAxisAngle(UP, this.turned)
      .add(new Vector3(x, y, z));
  }

  /** The inverse of {@link at}. */
  under(at: Vector3): Vector3 {
    const { x, y, z, scale } = this.model;
    return at
      .clone()
      .sub(new Vector3(x, y, z))
      .applyAxisAngle(UP, -this.turned)
      .divideScalar(scale);
  }
}

const coordinate = fc.double({ min: -0.5, max: 0.5, noNaN: true });
const place = fc.tuple(coordinate, coordinate, coordinate).map(([x, y, z]) => new Vector3(x, y, z));

describe('TableModel', () => {
  test('one hand moves it, and neither turns nor scales it', () => {
    fc.assert(
      fc.property(place, place, fc.boolean(), (from, to, left) => {
        const shown = new Shown();
        const held = shown.under(from);
        const { scale } = shown.model;
        for (const at of [from, to]) shown.follow(left ? hand(at) : open, left ? open : hand(at));
        expect(shown.at(held).distanceTo(to)).toBeLessThan(1e-9);
        expect([shown.turned, shown.model.scale]).toEqual([0, scale]);
      }),
      { seed: 9 },
    );
  });

  test('hands that stay level keep hold of what each of them has grabbed', () => {
    fc.assert(
      fc.property(place, place, place, place, (a, b, toA, toB) => {
        // A level turn cannot follow hands at different heights.
        b.y = a.y;
        toB.y = toA.y;
        fc.pre(a.distanceTo(b) > 0.1 && toA.distanceTo(toB) > 0.1);
        const shown = new Shown();
        shown.model.scale = 0.1;
        const ratio = toA.distanceTo(toB) / a.distanceTo(b);
        fc.pre(ratio > 0.1 && ratio < 9);
        const [heldA, heldB] = [shown.under(a), shown.under(b)];
        shown.follow(hand(a), hand(b));
        shown.follow(hand(toA), hand(toB));
        expect(shown.at(heldA).distanceTo(toA)).toBeLessThan(1e-6);
        expect(shown.at(heldB).distanceTo(toB)).toBeLessThan(1e-6);
      }),
      { seed: 10 },
    );
  });

  test('hands that turn like a wheel turn it to the same side', () => {
    const model = new TableModel();
    model.follow(hand(new Vector3(-0.2, 0, 0)), hand(new Vector3(0.2, 0, 0)));
    // The right hand goes away from the operator, the left one comes: to the left, seen from above.
    model.follow(hand(new Vector3(-0.2, 0, 0.02)), hand(new Vector3(0.2, 0, -0.02)));
    expect(model.turned).toBeCloseTo(0.1, 2);
  });

  test('a hand that joins, leaves or begins anew moves nothing', () => {
    const model = new TableModel();
    const before = () => [model.x, model.y, model.z, model.scale];
    const first = before();
    const [a, b] = [hand(new Vector3(0, 0, 0)), hand(new Vector3(0.3, 0, 0))];
    model.follow(a, open);
    model.follow(a, b);
    model.follow(open, b);
    model.follow(open, open);
    expect(before()).toEqual(first);
    model.follow(a, open);
    model.letGo();
    model.follow(hand(new Vector3(1, 1, 1)), open);
    expect(before()).toEqual(first);
  });

  test('whatever hands do, its scale stays within bounds and its place is finite', () => {
    const step = fc.tuple(place, place, fc.boolean(), fc.boolean());
    fc.assert(
      fc.property(fc.array(step), (steps) => {
        const model = new TableModel();
        for (const [a, b, holdsA, holdsB] of steps) {
          model.follow(hand(a, holdsA), hand(b, holdsB));
          expect(model.scale).toBeGreaterThanOrEqual(MODEL_SCALE.least);
          expect(model.scale).toBeLessThanOrEqual(MODEL_SCALE.most);
          expect(Number.isFinite(model.x + model.y + model.z + model.turned)).toBe(true);
        }
        model.reset();
        expect(model.scale).toBe(new TableModel().scale);
      }),
      { seed: 11 },
    );
  });

  test('hands that meet neither turn nor scale it', () => {
    const model = new TableModel();
    const { scale } = model;
    model.follow(hand(new Vector3(0, 0, 0)), hand(new Vector3(0.01, 0, 0)));
    model.follow(hand(new Vector3(0, 0, 0)), hand(new Vector3(-0.2, 0, 0.2)));
    expect([model.turned, model.scale]).toEqual([0, scale]);
  });
});
