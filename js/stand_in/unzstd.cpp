// Frames of zstd, read as RFC 8878 describes them; its sections stand beside the code. Dictionaries are not read.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <vector>

#include "zstd.h"

namespace prohull_zstd {
namespace {

using Bytes = std::vector<unsigned char>;

enum Failure : std::size_t { Unknown = 1, Corrupt, Checksum, TooLarge, Dictionary, kFailures };
constexpr const char* kFailureNames[]{"",
                                      "Unknown frame descriptor",
                                      "Data corruption detected",
                                      "Restored data doesn't match checksum",
                                      "Frame requires too much memory for decoding",
                                      "Dictionary mismatch"};

void expect(bool holds, Failure otherwise = Corrupt) {
  if (!holds) throw otherwise;
}

unsigned log2_of(std::uint64_t positive) { return static_cast<unsigned>(std::bit_width(positive)) - 1; }

/// Bytes that are read one after the other.
struct Input {
  const unsigned char *at, *end;

  std::size_t left() const { return static_cast<std::size_t>(end - at); }
  const unsigned char* take(std::size_t count) {
    expect(count <= left());
    return (at += count) - count;
  }
  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    std::memcpy(&value, take(bytes), bytes);
    return value;
  }
};

/// Up to 32 bits from bit `from` on. Bits before the first byte and behind the last one are 0.
std::uint64_t bits_at(const Input& in, std::int64_t from, unsigned count) {
  if (from < 0) return from + count <= 0 ? 0 : bits_at(in, 0, static_cast<unsigned>(from + count)) << -from;
  std::uint64_t value = 0;
  const std::size_t first = static_cast<std::size_t>(from) / 8;
  if (first < in.left()) std::memcpy(&value, in.at + first, std::min<std::size_t>(8, in.left() - first));
  return value >> from % 8 & ((std::uint64_t{1} << count) - 1);
}

/// A bitstream, which is read from its end; its highest bit says where that is (4.1).
class BackwardBits {
 public:
  explicit BackwardBits(Input in) : in_(in) {
    expect(in.left() > 0 && in.end[-1] != 0);
    left_ = 8 * (static_cast<std::int64_t>(in.left()) - 1) + log2_of(in.end[-1]);
  }
  std::uint64_t peek(unsigned count) const { return bits_at(in_, left_ - count, count); }
  std::uint64_t read(unsigned count) { return left_ -= count, bits_at(in_, left_, count); }
  std::int64_t left() const { return left_; }  ///< negative if more was read than there was

 private:
  Input in_;
  std::int64_t left_;
};

/// A table of Finite State Entropy: what a state stands for, and which one follows it (4.1).
class StateTable {
 public:
  struct State {
    unsigned char symbol = 0, bits = 0;
    std::uint16_t base = 0;
  };

  /// With the same symbol for ever.
  explicit StateTable(unsigned char symbol) : log_(0), states_{{symbol, 0, 0}} {}

  /// `shares`: how many states each symbol has; -1 for one that is less likely than one state (4.1.1).
  StateTable(const std::vector<int>& shares, unsigned log) : log_(log), states_(std::size_t{1} << log) {
    const std::size_t size = states_.size(), step = size / 2 + size / 8 + 3;
    std::size_t high = size, at = 0;
    std::vector<unsigned> next(shares.begin(), shares.end());
    for (std::size_t s = 0; s < shares.size(); ++s)
      if (shares[s] == -1) states_[--high].symbol = static_cast<unsigned char>(s), next[s] = 1;
    for (std::size_t s = 0; s < shares.size(); ++s)
      for (int i = 0; i < shares[s]; ++i) {
        states_[at].symbol = static_cast<unsigned char>(s);
        do at = (at + step) % size;
        while (at >= high);
      }
    expect(at == 0);
    for (State& state : states_) {
      const unsigned mark = next[state.symbol]++;
      state.bits = static_cast<unsigned char>(log - log2_of(mark));
      state.base = static_cast<std::uint16_t>((mark << state.bits) - size);
    }
  }

  /// Reads the description of a table (4.1.1).
  static StateTable read(Input& in, unsigned most_log, std::size_t most_symbols) {
    std::int64_t at = 0;
    const auto bits = [&](unsigned count) { return static_cast<int>(bits_at(in, (at += count) - count, count)); };
    const unsigned log = 5 + static_cast<unsigned>(bits(4));
    expect(log <= most_log);
    std::vector<int> shares;
    int left = 1 << log;
    while (left > 0) {
      const unsigned count = log2_of(static_cast<unsigned>(left) + 1) + 1;
      const int half = 1 << (count - 1), short_ones = 2 * half - 1 - (left + 1);
      int value = bits(count);
      if ((value & (half - 1)) < short_ones)
        value &= half - 1, --at;
      else if (value >= half)
        value -= short_ones;
      const int share = value - 1;
      shares.push_back(share);
      left -= share < 0 ? -share : share;
      for (int repeat = share == 0 ? 3 : 0; repeat == 3;)
        repeat = bits(2), shares.insert(shares.end(), static_cast<std::size_t>(repeat), 0);
      expect(shares.size() <= most_symbols && left >= 0);
    }
    in.take(static_cast<std::size_t>(at + 7) / 8);
    return {shares, log};
  }

  unsigned log() const { return log_; }
  const State& operator[](std::size_t state) const { return states_[state]; }

 private:
  unsigned log_;
  std::vector<State> states_;
};

/// A state of a table, as a bitstream leads from one to the next.
class Walk {
 public:
  Walk(const StateTable& table, BackwardBits& bits) : table_(table), state_(bits.read(table.log())) {}
  unsigned char symbol() const { return table_[state_].symbol; }
  void go_on(BackwardBits& bits) {
    const auto& state = table_[state_];
    state_ = state.base + bits.read(state.bits);
  }

 private:
  const StateTable& table_;
  std::size_t state_;
};

/// A Huffman code (4.2.1): what each number of log() bits begins with.
class HuffmanTable {
 public:
  static HuffmanTable read(Input& in) {
    const unsigned char kind = *in.take(1);
    Bytes weights;
    if (kind >= 128) {
      const std::size_t count = kind - 127u;
      const unsigned char* const halves = in.take((count + 1) / 2);
      for (std::size_t i = 0; i < count; ++i)
        weights.push_back(static_cast<unsigned char>(i % 2 == 0 ? halves[i / 2] >> 4 : halves[i / 2] & 15));
    } else {
      const unsigned char* const start = in.take(kind);
      weights = weights_of({start, start + kind});
    }
    return HuffmanTable(std::move(weights));
  }

  void decode(Input in, unsigned char* to, std::size_t count) const {
    BackwardBits bits(in);
    for (unsigned char* const end = to + count; to != end; ++to) {
      const auto& [symbol, length] = codes_[bits.peek(log_)];
      *to = symbol;
      bits.read(length);
    }
    expect(bits.left() == 0);
  }

 private:
  struct Code {
    unsigned char symbol, length;
  };
  static constexpr unsigned kMostLog = 11;

  /// Two states take turns, until no bits are left for the next one (4.2.1.2).
  static Bytes weights_of(Input in) {
    const StateTable table = StateTable::read(in, 6, 256);
    BackwardBits bits(in);
    Walk walks[]{{table, bits}, {table, bits}};
    Bytes weights;
    for (std::size_t turn = 0; bits.left() >= 0; turn = 1 - turn) {
      weights.push_back(walks[turn].symbol());
      expect(weights.size() < 255);
      walks[turn].go_on(bits);
      if (bits.left() < 0) weights.push_back(walks[1 - turn].symbol());
    }
    return weights;
  }

  /// The weight of the last symbol is left out, as that completes a power of two.
  explicit HuffmanTable(Bytes weights) {
    std::uint32_t sum = 0;
    for (const unsigned char weight : weights) expect(weight <= kMostLog), sum += weight > 0 ? 1u << (weight - 1) : 0;
    expect(sum > 0);
    log_ = log2_of(sum) + 1;
    const std::uint32_t rest = (1u << log_) - sum;
    expect(log_ <= kMostLog && std::has_single_bit(rest));
    weights.push_back(static_cast<unsigned char>(log2_of(rest) + 1));
    for (unsigned weight = 1; weight <= log_; ++weight)
      for (std::size_t s = 0; s < weights.size(); ++s)
        if (weights[s] == weight)
          codes_.insert(codes_.end(), std::size_t{1} << (weight - 1),
                        {static_cast<unsigned char>(s), static_cast<unsigned char>(log_ + 1 - weight)});
  }

  unsigned log_;
  std::vector<Code> codes_;
};

/// What codes of sequences stand for (3.1.1.3.2.1.1): numbers from `least` on, those of a code from where those of the
/// code before end.
struct Codes {
  Codes(std::uint32_t least, unsigned plain, std::initializer_list<unsigned char> others, unsigned most_log,
        StateTable usual)
      : extra_bits(plain, 0), most_log(most_log), usual(std::move(usual)) {
    extra_bits.insert(extra_bits.end(), others);
    for (const unsigned char bits : extra_bits) bases.push_back(least), least += 1u << bits;
  }
  std::uint32_t read(unsigned code, BackwardBits& bits) const {
    expect(code < bases.size());
    return bases[code] + static_cast<std::uint32_t>(bits.read(extra_bits[code]));
  }

  Bytes extra_bits;
  std::vector<std::uint32_t> bases;
  unsigned most_log;  ///< of a table that is described
  StateTable usual;   ///< needs no description (3.1.1.3.2.2)
};

const Codes kLiterals{
    0,
    16,
    {1, 1, 1, 1, 2, 2, 3, 3, 4, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16},
    9,
    {{4, 3, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 2, 1, 1, 1, 1, 1, -1, -1, -1, -1},
     6}};
const Codes kMatches{3,
                     32,
                     {1, 1, 1, 1, 2, 2, 3, 3, 4, 4, 5, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16},
                     9,
                     {{1, 4, 3, 2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,  1,  1,  1,  1,  1,  1, 1,
                       1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1},
                      6}};
const Codes kOffsets{
    1,
    1,
    {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31},
    8,
    {{1, 1, 1, 1, 1, 1, 2, 2, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1, -1}, 5}};

std::optional<StateTable> table_of(unsigned mode, const Codes& codes, Input& in, std::optional<StateTable> last) {
  if (mode == 0) return codes.usual;
  if (mode == 1) return StateTable(*in.take(1));
  if (mode == 2) return StateTable::read(in, codes.most_log, codes.bases.size());
  expect(last.has_value());
  return last;
}

}  // namespace

/// What blocks of a frame leave to the next ones.
class Frame {
 public:
  /// Takes the next part of a frame, its header or a block, if all of it is there; whether more has to come.
  bool read(Input& in, std::size_t most_window) { return is_begun_ ? read_block(in) : read_header(in, most_window); }

  Bytes content;

 private:
  bool read_header(Input& in, std::size_t most_window) {  // 3.1.1.1
    const Input before = in;
    if (in.left() < 5) return true;
    expect(in.number(4) == 0xFD2FB528, Unknown);
    const unsigned char descriptor = *in.take(1);
    const bool is_single = descriptor & 32;
    const std::size_t dictionary[]{0, 1, 2, 4}, size[]{is_single ? 1u : 0u, 2, 4, 8};
    if (in.left() < 1 - is_single + dictionary[descriptor & 3] + size[descriptor >> 6]) return in = before, true;
    expect((descriptor & 8) == 0, Unknown);
    std::uint64_t window = 0;
    if (!is_single) {
      const unsigned char byte = *in.take(1);
      window = std::uint64_t{1} << (10 + (byte >> 3));
      window += window / 8 * (byte & 7);
    }
    expect(in.number(dictionary[descriptor & 3]) == 0, Dictionary);
    const std::uint64_t bytes = in.number(size[descriptor >> 6]) + (descriptor >> 6 == 1 ? 256 : 0);
    if (size[descriptor >> 6] > 0) size_ = bytes;
    window_ = is_single ? bytes : window;
    expect(window_ <= most_window, TooLarge);
    has_checksum_ = descriptor & 4;
    return is_begun_ = true;
  }

  bool read_block(Input& in) {  // 3.1.1.2
    Input next = in;
    if (next.left() < 3) return true;
    const auto header = static_cast<std::size_t>(next.number(3)), kind = header >> 1 & 3, size = header >> 3;
    const bool is_last = header & 1;
    expect(kind != 3 && size <= std::min<std::uint64_t>(kBlock, window_));
    const std::size_t stored = kind == 1 ? 1 : size;
    if (next.left() < stored + (is_last && has_checksum_ ? 4 : 0)) return true;
    const unsigned char* const bytes = next.take(stored);
    const std::size_t before = content.size();
    if (kind == 0)
      content.insert(content.end(), bytes, bytes + size);
    else if (kind == 1)
      content.insert(content.end(), size, *bytes);
    else
      read_compressed({bytes, bytes + size});
    expect(content.size() - before <= kBlock);
    if (is_last) {
      expect(!size_ || *size_ == content.size());
      if (has_checksum_)
        expect(next.number(4) == static_cast<std::uint32_t>(xxh64(content.data(), content.size())), Checksum);
    }
    in = next;
    return !is_last;
  }

  void read_compressed(Input in) {
    const Bytes literals = read_literals(in);
    const std::size_t sequences = read_sequence_count(in);
    const std::size_t before = content.size();
    const unsigned char* literal = literals.data();
    const unsigned char* const end = literal + literals.size();
    if (sequences > 0) {
      const unsigned char modes = *in.take(1);
      expect((modes & 3) == 0);
      literal_lengths_ = table_of(modes >> 6, kLiterals, in, std::move(literal_lengths_));
      offsets_ = table_of(modes >> 4 & 3, kOffsets, in, std::move(offsets_));
      match_lengths_ = table_of(modes >> 2 & 3, kMatches, in, std::move(match_lengths_));
      BackwardBits bits(in);
      Walk lengths(*literal_lengths_, bits), offsets(*offsets_, bits), matches(*match_lengths_, bits);
      for (std::size_t i = 0; i < sequences; ++i) {
        const std::uint64_t value = kOffsets.read(offsets.symbol(), bits);
        const std::size_t match = kMatches.read(matches.symbol(), bits);
        const std::size_t count = kLiterals.read(lengths.symbol(), bits);
        if (i + 1 < sequences) lengths.go_on(bits), matches.go_on(bits), offsets.go_on(bits);
        expect(bits.left() >= 0 && count <= static_cast<std::size_t>(end - literal));
        expect(content.size() - before + count + match <= kBlock);
        content.insert(content.end(), literal, literal + count);
        literal += count;
        repeat(offset_of(value, count == 0), match);
      }
      expect(bits.left() == 0);
    } else {
      expect(in.left() == 0);
    }
    content.insert(content.end(), literal, end);
  }

  Bytes read_literals(Input& in) {  // 3.1.1.3.1
    expect(in.left() > 0);
    const unsigned kind = *in.at & 3, format = *in.at >> 2 & 3;
    if (kind < 2) {
      const bool is_short = format % 2 == 0;
      const std::size_t size = in.number(is_short ? 1 : format == 1 ? 2 : 3) >> (is_short ? 3 : 4);
      expect(size <= kBlock);
      if (kind == 1) return Bytes(size, *in.take(1));
      const unsigned char* const bytes = in.take(size);
      return Bytes(bytes, bytes + size);
    }
    const unsigned bits = format < 2 ? 10 : format == 2 ? 14 : 18;
    const std::uint64_t header = in.number((4 + 2 * bits) / 8) >> 4, mask = (1u << bits) - 1;
    const std::size_t size = header & mask, stored = header >> bits & mask;
    expect(size <= kBlock);
    const unsigned char* const start = in.take(stored);
    Input own{start, start + stored};
    if (kind == 2) huffman_ = HuffmanTable::read(own);
    expect(huffman_.has_value());
    Bytes literals(size);
    if (format == 0) return huffman_->decode(own, literals.data(), size), literals;
    std::size_t streams[3];
    for (std::size_t& stream : streams) stream = static_cast<std::size_t>(own.number(2));
    const std::size_t each = (size + 3) / 4;
    expect(3 * each <= size);
    unsigned char* to = literals.data();
    for (const std::size_t stream : streams) {
      const unsigned char* const bytes = own.take(stream);
      huffman_->decode({bytes, bytes + stream}, to, each);
      to += each;
    }
    huffman_->decode(own, to, size - 3 * each);
    return literals;
  }

  static std::size_t read_sequence_count(Input& in) {  // 3.1.1.3.2.1
    const std::size_t first = *in.take(1);
    if (first < 128) return first;
    if (first < 255) return ((first - 128) << 8) + *in.take(1);
    return in.number(2) + 0x7F00;
  }

  /// The last three offsets can be named again (3.1.1.5).
  std::size_t offset_of(std::uint64_t value, bool is_without_literals) {
    if (value > 3) {
      recent_ = {value - 3, recent_[0], recent_[1]};
    } else {
      const std::size_t which = value - 1 + is_without_literals;
      const std::uint64_t offset = which < 3 ? recent_[which] : recent_[0] - 1;
      if (which == 1) recent_ = {offset, recent_[0], recent_[2]};
      if (which > 1) recent_ = {offset, recent_[0], recent_[1]};
    }
    return recent_[0];
  }

  void repeat(std::size_t offset, std::size_t count) {
    expect(offset > 0 && offset <= content.size());
    content.resize(content.size() + count);
    unsigned char* const to = content.data() + content.size() - count;
    for (std::size_t i = 0; i < count; ++i) to[i] = to[i - offset];  // they may overlap
  }

  bool is_begun_ = false, has_checksum_ = false;
  std::uint64_t window_ = 0;
  std::optional<std::uint64_t> size_;
  std::array<std::uint64_t, 3> recent_{1, 4, 8};
  std::optional<HuffmanTable> huffman_;
  std::optional<StateTable> literal_lengths_, offsets_, match_lengths_;
};

}  // namespace prohull_zstd

struct ZSTD_DStream {
  prohull_zstd::Frame frame;
  std::size_t most_window, given = 0;  ///< `given`: bytes of the content
};

ZSTD_DStream* ZSTD_createDStream() { return new ZSTD_DStream{{}, std::size_t{1} << 27}; }
std::size_t ZSTD_freeDStream(ZSTD_DStream* stream) { return delete stream, 0; }
std::size_t ZSTD_DCtx_setParameter(ZSTD_DStream* stream, int, int window_log) {
  return stream->most_window = std::size_t{1} << window_log, 0;
}
std::size_t ZSTD_DStreamOutSize() { return prohull_zstd::kBlock; }

/// A part at a time, so that the caller can stop what grows too much.
std::size_t ZSTD_decompressStream(ZSTD_DStream* stream, ZSTD_outBuffer* out, ZSTD_inBuffer* in) {
  using namespace prohull_zstd;
  const auto* const bytes = static_cast<const unsigned char*>(in->src);
  Input rest{bytes + in->pos, bytes + in->size};
  try {
    const bool goes_on = stream->frame.read(rest, stream->most_window);
    const auto at = static_cast<std::size_t>(rest.at - bytes);
    in->pos = at == in->pos ? in->size : at;  // of what is incomplete nothing was taken
    const Bytes& content = stream->frame.content;
    out->pos = content.size() - stream->given;
    std::copy(content.begin() + static_cast<std::ptrdiff_t>(stream->given), content.end(),
              static_cast<unsigned char*>(out->dst));
    stream->given = content.size();
    return goes_on;
  } catch (const Failure failure) {
    return 0 - failure;
  }
}

unsigned ZSTD_isError(std::size_t state) { return state > 0 - std::size_t{prohull_zstd::kFailures}; }
const char* ZSTD_getErrorName(std::size_t state) { return prohull_zstd::kFailureNames[0 - state]; }
