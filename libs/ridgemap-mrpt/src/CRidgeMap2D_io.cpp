// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/serialization/CArchive.h>
#include <ridgemap/CRidgeMap2D.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "byte_stream.h"
#include "checksum.h"
#include "frozen_polylines.h"
#include "map_state.h"
#include "option_text.h"

// Version 0: number of bytes (8), the bytes, their CRC-32 (4), integers little-endian. The bytes are: the three generic
// parameters of MRPT, all options as pairs of texts, and the lattice cells in canonical order, each as differences to
// the one before. Polylines are a pure function of these, so they are traced again when they are asked for.
// Version 1 is a frozen map: the polylines instead of the cells, their points as differences, too, in units of 2^-20 m.
// Version 2 is version 0 with the free-space counters behind the lattice cells, and behind these the scans that a
// sliding window has to take out again, as the bits of their numbers. It is written if there are any of these.

namespace ridgemap
{
namespace
{
constexpr std::uint8_t plainVersion = 0, frozenVersion = 1, freeSpaceVersion = 2;

void writeOptions(ByteWriter& out, const MapOptions& options)
{
	const auto keys = MapOptions::keys();
	out.number(keys.size());
	const auto write = [&](const FieldInfo& info, const auto& field)
	{
		out.text(info.key);
		out.text(optionText(field));
	};
	forEachSection(options, [&](const char*, const auto& section) { forEachField(section, write); });
}

MapOptions readOptions(ByteReader& in)
{
	MapOptions options;
	for (std::size_t n = in.count(2); n > 0; n--)
	{
		const std::string key = in.text(), value = in.text();
		options.setOption(key, value);
	}
	options.validate();
	return options;
}

void writeCells(ByteWriter& out, const std::vector<CellRecord>& cells)
{
	out.number(cells.size());
	std::int64_t cx = 0, cy = 0;
	for (const auto& c : cells)
	{
		out.signedNumber(c.cx - cx);
		out.signedNumber(c.cy - cy);
		out.number(c.bin);
		out.number(c.n);
		for (const std::int64_t sum : {c.sx, c.sy, c.sxx, c.sxy, c.syy}) out.signedNumber(sum);
		cx = c.cx;
		cy = c.cy;
	}
}

std::uint32_t readUint32(ByteReader& in)
{
	const std::uint64_t v = in.number();
	if (v > 0xffffffffu) throw std::runtime_error("stored ridge map: a count of a lattice cell is out of range");
	return std::uint32_t(v);
}

std::vector<CellRecord> readCells(ByteReader& in)
{
	constexpr std::size_t leastBytes = 9;  // one for each number
	std::vector<CellRecord> cells(in.count(leastBytes));
	std::uint64_t cx = 0, cy = 0;  // unsigned, for a forged difference must not overflow
	for (auto& c : cells)
	{
		c.cx = std::int64_t(cx += std::uint64_t(in.signedNumber()));
		c.cy = std::int64_t(cy += std::uint64_t(in.signedNumber()));
		c.bin = readUint32(in);
		c.n = readUint32(in);
		for (std::int64_t* sum : {&c.sx, &c.sy, &c.sxx, &c.sxy, &c.syy}) *sum = in.signedNumber();
	}
	return cells;
}

void writeFreeCells(ByteWriter& out, const std::vector<FreeCellRecord>& cells)
{
	out.number(cells.size());
	std::int64_t cx = 0, cy = 0;
	for (const auto& c : cells)
	{
		out.signedNumber(c.cx - cx);
		out.signedNumber(c.cy - cy);
		out.number(c.n);
		out.signedNumber(c.a);
		out.signedNumber(c.b);
		cx = c.cx;
		cy = c.cy;
	}
}

std::vector<FreeCellRecord> readFreeCells(ByteReader& in)
{
	constexpr std::size_t leastBytes = 5;
	std::vector<FreeCellRecord> cells(in.count(leastBytes));
	std::uint64_t cx = 0, cy = 0;
	for (auto& c : cells)
	{
		c.cx = std::int64_t(cx += std::uint64_t(in.signedNumber()));
		c.cy = std::int64_t(cy += std::uint64_t(in.signedNumber()));
		c.n = in.number();
		c.a = in.signedNumber();
		c.b = in.signedNumber();
	}
	return cells;
}

template <std::size_t N>
void writeFixed(mrpt::serialization::CArchive& out, std::uint64_t v)
{
	std::array<std::uint8_t, N> b;
	for (std::size_t i = 0; i < N; i++) b[i] = std::uint8_t(v >> (8 * i));
	out.WriteBuffer(b.data(), N);
}

void readExactly(mrpt::serialization::CArchive& in, std::uint8_t* to, std::size_t n)
{
	// Some streams of MRPT give fewer bytes than asked for at the end, without a word.
	if (n > 0 && in.ReadBuffer(to, n) != n) throw std::runtime_error("stored ridge map: the data end too early");
}

template <std::size_t N>
std::uint64_t readFixed(mrpt::serialization::CArchive& in)
{
	std::array<std::uint8_t, N> b;
	readExactly(in, b.data(), N);
	std::uint64_t v = 0;
	for (std::size_t i = 0; i < N; i++) v |= std::uint64_t(b[i]) << (8 * i);
	return v;
}

/** Reads piece by piece, so that a forged size ends at the end of the data, not of the memory. */
std::vector<std::uint8_t> readBytes(mrpt::serialization::CArchive& in, std::uint64_t size)
{
	constexpr std::uint64_t piece = 1 << 20;
	std::vector<std::uint8_t> bytes;
	while (bytes.size() < size)
	{
		const std::size_t at = bytes.size();
		bytes.resize(at + std::size_t(std::min(piece, size - at)));
		readExactly(in, bytes.data() + at, bytes.size() - at);
	}
	return bytes;
}

std::uint64_t contentKey(std::uint32_t crc, const std::vector<std::uint8_t>& bytes)
{
	return std::uint64_t(crc) << 32 ^ bytes.size();
}

bool beginsWith(const std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& head)
{
	return bytes.size() >= head.size() && std::equal(head.begin(), head.end(), bytes.begin());
}

void expectEnd(const ByteReader& in)
{
	if (in.left() != 0) throw std::runtime_error("stored ridge map: there are data behind the end of the map");
}

/** There is something that version 0 does not hold. */
bool hasMore(const MapState& state)
{
	return state.core.passedAnywhere() || !state.window.empty();
}

void writeContents(ByteWriter& out, const MapState& state)
{
	if (state.frozen) return writeFrozen(out, *state.frozen);
	writeCells(out, state.core.cells());
	if (!hasMore(state)) return;
	writeFreeCells(out, state.core.freeCells());
	state.window.write(out);
}

std::shared_ptr<MapState> readState(ByteReader& in, const Options& options, bool withFreeSpace)
{
	const auto cells = readCells(in);
	const auto freeCells = withFreeSpace ? readFreeCells(in) : std::vector<FreeCellRecord>();
	ScanWindow window = withFreeSpace ? ScanWindow::read(in) : ScanWindow();
	expectEnd(in);
	auto state = std::make_shared<MapState>(options);
	state->core.insertCells(cells);
	state->core.insertFreeCells(freeCells);
	state->window = std::move(window);
	return state;
}

std::shared_ptr<MapState> readFrozenState(ByteReader& in, const Options& options)
{
	auto lines = readFrozen(in);
	expectEnd(in);
	auto state = std::make_shared<MapState>(options);
	state->frozen = std::make_shared<const std::vector<Polyline>>(std::move(lines));
	return state;
}
}  // namespace

uint8_t CRidgeMap2D::serializeGetVersion() const
{
	return isFrozen() ? frozenVersion : hasMore(*state_) ? freeSpaceVersion : plainVersion;
}

void CRidgeMap2D::serializeTo(mrpt::serialization::CArchive& out) const
{
	ByteWriter content;
	content.byte(genericMapParams.enableSaveAs3DObject);
	content.byte(genericMapParams.enableObservationLikelihood);
	content.byte(genericMapParams.enableObservationInsertion);
	writeOptions(content, mapOptions());
	// Filters write the map of a good particle several times in a row. What begins alike goes on alike, for the state
	// has not changed.
	auto stored = storedAs(state_);
	if (!stored || !beginsWith(stored->bytes, content.bytes()))
	{
		writeContents(content, *state_);
		stored = std::make_shared<const StoredMap>(StoredMap{serializeGetVersion(), content.bytes()});
	}
	const auto& bytes = stored->bytes;
	writeFixed<8>(out, bytes.size());
	out.WriteBuffer(bytes.data(), bytes.size());
	const std::uint32_t crc = crc32(bytes.data(), bytes.size());
	writeFixed<4>(out, crc);
	rememberState(contentKey(crc, bytes), state_, stored);
}

void CRidgeMap2D::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version)
{
	if (version > freeSpaceVersion)
		throw std::runtime_error("stored ridge map: version " + std::to_string(version) +
								 " is newer than this library, which reads versions 0 to 2");
	const StoredMap stored{version, readBytes(in, readFixed<8>(in))};
	const auto& bytes = stored.bytes;
	const std::uint32_t crc = crc32(bytes.data(), bytes.size());
	if (readFixed<4>(in) != crc)
		throw std::runtime_error("stored ridge map: the checksum does not fit, the data are damaged");
	ByteReader content(bytes);
	const bool as3D = content.byte() != 0, likelihood = content.byte() != 0, insertion = content.byte() != 0;
	CRidgeMap2D loaded(readOptions(content));
	loaded.genericMapParams.enableSaveAs3DObject = as3D;
	loaded.genericMapParams.enableObservationLikelihood = likelihood;
	loaded.genericMapParams.enableObservationInsertion = insertion;
	if (auto living = findState(contentKey(crc, bytes), stored))
		loaded.state_ = std::move(living);
	else
		loaded.state_ = version == frozenVersion ? readFrozenState(content, loaded.options())
												 : readState(content, loaded.options(), version == freeSpaceVersion);
	swap(loaded);
}

}  // namespace ridgemap
