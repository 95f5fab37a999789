import type { Rect, Stage } from './stage.ts';

/** Of a rectangle around a place, shares of the canvas. */
const SIZE = { width: 0.02, height: 0.03 };

/**
 * Where a direction of the robot's camera is on the canvas, in first person.
 *
 * @param right  tangent of the angle to the right of straight ahead
 * @param down   tangent of the angle below it
 */
export async function screenPlace(
  stage: Stage,
  { right, down }: { right: number; down: number },
): Promise<Rect> {
  const [fx, fy] = await stage.script(({ app }) => {
    const { elements } = app.stage.viewCamera.projectionMatrix;
    return [elements[0], elements[5]] as const;
  });
  const { width, height } = SIZE;
  return {
    ...{ x: 0.5 + (right * fx) / 2 - width / 2, y: 0.5 + (down * fy) / 2 - height / 2 },
    ...SIZE,
  };
}
