/** Chooses ports for programs that people know by their usual numbers: those, or the next free ones. */

export interface WantedPort {
  /** For people: what listens there. */
  name: string;
  port: number;
  /** This port and no other. */
  fixed?: boolean;
}

export interface ChosenPorts {
  /** In the order of the wanted ports. */
  ports: number[];
  /** Wanted ports that are in use. */
  moved: { wanted: WantedPort; port: number }[];
}

/** A port with `fixed` is in use. */
export class PortTaken extends Error {
  override readonly name = 'PortTaken';
  readonly wanted: WantedPort;

  constructor(wanted: WantedPort) {
    super(`port ${wanted.port} is taken`);
    this.wanted = wanted;
  }
}

const MOST_PORT = 65_535;

/** @throws {PortTaken} */
export async function choosePorts(
  wanted: readonly WantedPort[],
  isFree: (port: number) => Promise<boolean>,
): Promise<ChosenPorts> {
  // A port that another of our programs wants by its number stays reserved for it.
  const spoken = new Set(wanted.map(({ port }) => port));
  const chosen: ChosenPorts = { ports: [], moved: [] };
  for (const want of wanted) {
    let { port } = want;
    if (!(await isFree(port))) {
      do port++;
      while (!want.fixed && port <= MOST_PORT && (spoken.has(port) || !(await isFree(port))));
      if (want.fixed || port > MOST_PORT) throw new PortTaken(want);
      spoken.add(port);
      chosen.moved.push({ wanted: want, port });
    }
    chosen.ports.push(port);
  }
  return chosen;
}
