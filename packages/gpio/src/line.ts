import { loadAddon } from './addon.ts';

/** Where a line is, and which level means that it is active. */
export interface GpioLineAt {
  /** E.g. `/dev/gpiochip0`. */
  chip: string;
  /** The line's offset on its chip. */
  line: number;
  activeLow: boolean;
}

/** An input line, requested for as long as it is open: no other program changes it meanwhile. */
export interface GpioLine {
  /** Asks the chip. @throws {Error} saying why it cannot be read */
  isActive(): boolean;
  close(): void;
}

/** What the system's refusals mean here. */
const WORDS: Readonly<Record<string, string>> = {
  ENOENT: 'there is no such chip',
  EACCES: 'the system does not permit it: add the robot’s user to the group of the device',
  EPERM:
    'a device policy does not permit it: DeviceAllow=char-gpiochip in the service’s unit, --device of a container',
  EBUSY: 'another program or driver uses the line',
  EINVAL: 'the chip has no such line',
  ENOTTY: 'it is no GPIO chip',
  ENODEV: 'the chip is gone',
};

/**
 * Requests a line as an input. Needs Linux 5.10 or newer.
 *
 * @throws {Error} saying why it cannot be read
 */
export function openGpioLine({ chip, line, activeLow }: GpioLineAt): GpioLine {
  const addon = loadAddon();
  const described = (error: unknown): Error => {
    const { code = '', message } = error as NodeJS.ErrnoException;
    return new Error(`${chip} line ${line}: ${WORDS[code] ?? message}`, { cause: error });
  };
  const attempt = <T>(access: () => T): T => {
    try {
      return access();
    } catch (error) {
      throw described(error);
    }
  };
  const handle = attempt(() => addon.open(chip, line, activeLow));
  return {
    isActive: () => attempt(() => addon.active(handle)),
    close: () => addon.close(handle),
  };
}
