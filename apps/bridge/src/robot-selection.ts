/** Which of the robots streams: one at most. Pure; what it decides is carried out by the rim. */

export interface SelectionEvents {
  /** `start` for the one that is shown, `stop` for every other. */
  onSwitch: (robotId: number, word: 'start' | 'stop') => void;
  /** Another robot is shown now; `null` where none is. */
  onSelected: (robotId: number | null) => void;
}

/**
 * The first robot to come is shown until one is chosen. A chosen robot that goes and comes back by the same name, under
 * another id as the protocol has it, is shown again.
 */
export class RobotSelection {
  selected: number | null = null;
  readonly #events: SelectionEvents;
  readonly #names = new Map<number, string>();
  /** Name of the robot that was chosen, or came first. */
  #wanted: string | null = null;

  constructor(events: SelectionEvents) {
    this.#events = events;
  }

  get robots(): { id: number; name: string }[] {
    return [...this.#names].map(([id, name]) => ({ id, name }));
  }

  add(id: number, name: string): void {
    this.#names.set(id, name);
    if (this.selected === null && (this.#wanted === null || this.#wanted === name)) this.select(id);
  }

  remove(id: number): void {
    this.#names.delete(id);
    if (this.selected !== id) return;
    this.selected = null;
    // Its other connection may be here already.
    const same = this.robots.find(({ name }) => name === this.#wanted);
    if (same === undefined) this.#events.onSelected(null);
    else this.select(same.id);
  }

  /** The same robot is known by another id from now on; the first is free. */
  rekey(from: number, to: number): void {
    const name = this.#names.get(from);
    if (name === undefined) return;
    this.#names.delete(from);
    this.#names.set(to, name);
    if (this.selected !== from) return;
    this.selected = to;
    this.#events.onSelected(to);
  }

  /** @returns false where there is no such robot: nothing changes then */
  select(id: number): boolean {
    const name = this.#names.get(id);
    if (name === undefined) return false;
    this.#wanted = name;
    if (this.selected === id) return true;
    const before = this.selected;
    this.selected = id;
    if (before !== null) this.#events.onSwitch(before, 'stop');
    this.#events.onSwitch(id, 'start');
    this.#events.onSelected(id);
    return true;
  }

  /** What a robot whose channel has just opened is to be told. */
  wordFor(id: number): 'start' | 'stop' {
    return id === this.selected ? 'start' : 'stop';
  }
}
