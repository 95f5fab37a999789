import { join } from 'node:path';

/** The C sources that the programs have in common. */
export const MEDIA_PROCESS_SOURCES = join(import.meta.dirname, '..', 'native');
