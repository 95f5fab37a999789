//! The check value of headers and packets.

/// CRC-16/CCITT-FALSE (polynomial 0x1021, first 0xFFFF) over parts that belong together.
#[must_use]
pub fn crc16(parts: &[&[u8]]) -> u16 {
    const TABLE: [[u16; 256]; 8] = {
        let mut table = [[0; 256]; 8];
        let mut i = 0;
        while i < 256 {
            let mut crc = (i as u16) << 8;
            let mut bit = 0;
            while bit < 8 {
                crc = if crc & 0x8000 == 0 { crc << 1 } else { crc << 1 ^ 0x1021 };
                bit += 1;
            }
            table[0][i] = crc;
            i += 1;
        }
        // table[n]: the byte with n zero bytes after it.
        let mut n = 1;
        while n < 8 {
            let mut i = 0;
            while i < 256 {
                let crc: u16 = table[n - 1][i];
                table[n][i] = crc << 8 ^ table[0][(crc >> 8) as usize];
                i += 1;
            }
            n += 1;
        }
        table
    };
    let mut crc = 0xffff_u16;
    for part in parts {
        let (eights, rest) = part.as_chunks::<8>();
        for eight in eights {
            crc = TABLE[7][usize::from((crc >> 8) as u8 ^ eight[0])]
                ^ TABLE[6][usize::from(crc as u8 ^ eight[1])]
                ^ TABLE[5][usize::from(eight[2])]
                ^ TABLE[4][usize::from(eight[3])]
                ^ TABLE[3][usize::from(eight[4])]
                ^ TABLE[2][usize::from(eight[5])]
                ^ TABLE[1][usize::from(eight[6])]
                ^ TABLE[0][usize::from(eight[7])];
        }
        for byte in rest {
            crc = crc << 8 ^ TABLE[0][usize::from((crc >> 8) as u8 ^ byte)];
        }
    }
    crc
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_value_is_the_standards() {
        assert_eq!(crc16(&[b"123456789"]), 0x29b1);
        assert_eq!(crc16(&[b"1234", b"56789"]), 0x29b1);
        assert_eq!(crc16(&[b"1", b"23456789"]), 0x29b1);
    }
}
