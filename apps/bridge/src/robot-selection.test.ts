import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RobotSelection } from './robot-selection.ts';

function selection() {
  const streaming = new Set<number>();
  const shown: (number | null)[] = [];
  const made = new RobotSelection({
    onSwitch: (id, word) => (word === 'start' ? streaming.add(id) : streaming.delete(id)),
    onSelected: (id) => shown.push(id),
  });
  return { made, streaming, shown };
}

describe('RobotSelection', () => {
  it('shows the first robot, then the chosen one', () => {
    const { made, streaming, shown } = selection();
    made.add(0, 'a');
    made.add(1, 'b');
    expect([...streaming]).toEqual([0]);
    expect(made.select(1)).toBe(true);
    expect([...streaming]).toEqual([1]);
    expect(made.select(2)).toBe(false);
    expect(shown).toEqual([0, 1]);
    expect([made.wordFor(0), made.wordFor(1)]).toEqual(['stop', 'start']);
  });

  it('finds the chosen robot again by name, whether it registers before or after its old entry ends', () => {
    const { made, shown } = selection();
    made.add(0, 'a');
    made.add(1, 'b');
    made.select(1);
    made.remove(1);
    made.add(2, 'c');
    made.add(3, 'b');
    made.add(4, 'b');
    made.remove(3);
    expect(shown).toEqual([0, 1, null, 3, 4]);
  });

  it('never has two robots streaming', () => {
    const step = fc.tuple(fc.constantFrom('add', 'remove', 'select'), fc.nat(5), fc.constantFrom('a', 'b'));
    fc.assert(
      fc.property(fc.array(step), (steps) => {
        const { made, streaming } = selection();
        for (const [what, id, name] of steps) {
          if (what === 'add') made.add(id, name);
          else if (what === 'select') made.select(id);
          else {
            made.remove(id);
            streaming.delete(id); // its connection is closed
          }
          expect([...streaming]).toEqual(made.selected === null ? [] : [made.selected]);
        }
      }),
      { seed: 1 },
    );
  });
});
