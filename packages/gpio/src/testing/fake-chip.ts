/** A stand-in for a GPIO chip, for programs that are started with its environment; see fake_chip.c. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const FAKE_CHIP = '/dev/gpiochip7';

export class FakeChip {
  /** For the program that is to see the chip. */
  readonly env: Readonly<Record<string, string>>;
  readonly #folder: string;

  private constructor(folder: string, library: string) {
    this.#folder = folder;
    this.env = { LD_PRELOAD: library, FAKE_GPIO: folder };
  }

  /** @returns `null` without Linux or a C compiler */
  static build(): FakeChip | null {
    if (process.platform !== 'linux') return null;
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-gpio-'));
    const library = join(folder, 'fake_chip.so');
    const source = join(import.meta.dirname, 'fake_chip.c');
    const flags = ['-shared', '-fPIC', '-O1', '-D_GNU_SOURCE', '-Wall', '-Werror'];
    const { status, error } = spawnSync('cc', [...flags, '-o', library, source]);
    if (error === undefined && status === 0) return new FakeChip(folder, library);
    rmSync(folder, { recursive: true, force: true });
    return null;
  }

  /** Sets a line's level at the pin. */
  set(line: number, high: boolean): void {
    const path = join(this.#folder, String(line));
    writeFileSync(`${path}.new`, high ? '1' : '0');
    renameSync(`${path}.new`, path);
  }

  /** The chip is gone, as a USB adapter that is unplugged. */
  unplug(line: number): void {
    rmSync(join(this.#folder, String(line)), { force: true });
  }

  close(): void {
    rmSync(this.#folder, { recursive: true, force: true });
  }
}
